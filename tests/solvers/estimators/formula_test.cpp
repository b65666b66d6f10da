// Formulas of K: what they compute, and that the built-in estimators written as formulas are these estimators.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "solvers/estimators/formula_compiler.hpp"
#include "solvers/estimators/k_kernels.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hand_scene.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/sample.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

/// A context of random numbers with its J'WJ.
template <std::size_t P>
struct Problem {
  core::Symmetric<double, P> matrix;
  core::Vector<double, P> gradient;
  core::Vector<double, P> step;
  double sigma2;
  double squares;
  double iteration;
  std::size_t observations;

  explicit Problem(std::mt19937_64& engine) {
    for (std::size_t i = 0; i < P; ++i) {
      gradient[i] = normal(engine);
      step[i] = normal(engine);
      for (std::size_t j = 0; j < i; ++j) matrix(i, j) = 0.3 * normal(engine);
      matrix(i, i) = uniform(engine, 2.0, 5.0);
    }
    sigma2 = uniform(engine, 0.001, 1.0);
    squares = uniform(engine, 0.1, 9.0);
    iteration = std::floor(uniform(engine, 0.0, 9.0));
    observations = P + static_cast<std::size_t>(uniform(engine, 0.0, 5.0));
  }

  solvers::RidgeMatrix<double, P> k(const char* estimator, const solvers::SolverOptions& options) const {
    solvers::KContext<double, P> c{{matrix, gradient}, step,         squares, sigma2, {}, {}, {},
                                   iteration,          observations, nullptr, options};
    solvers::RidgeMatrix<double, P> out;
    solvers::k_kernel<double, P>(k_index(estimator))(c, out);
    return out;
  }
  core::Vector<double, P> formula(const std::string& text) const {
    solvers::SolverOptions options;
    options.k_formula = solvers::compile_k(text);
    return core::diagonal(k("expr", options));
  }
};

/// The value of a formula that names no quantity but alpha = (x, y).
double value(const std::string& text, double x = 1.0, double y = 1.0) {
  std::mt19937_64 engine(1);
  Problem<2> problem(engine);
  problem.step = {x, y};
  return problem.formula(text)[0];
}

using Exact = long double;

/// What a formula may use, in long double.
struct Quantities {
  Exact sigma2, n, p, iteration, trace, squares;
  std::vector<Exact> alpha, gradient, diagonal;

  template <std::size_t P>
  explicit Quantities(const Problem<P>& of)
      : sigma2(of.sigma2),
        n(static_cast<Exact>(of.observations)),
        p(P),
        iteration(of.iteration),
        trace(0.0L),
        squares(of.squares),
        alpha(of.step.begin(), of.step.end()),
        gradient(of.gradient.begin(), of.gradient.end()) {
    for (std::size_t i = 0; i < P; ++i) {
      diagonal.push_back(of.matrix(i, i));
      trace += diagonal.back();
    }
  }

  template <class F>
  std::vector<Exact> each(F f) const {
    std::vector<Exact> values;
    for (std::size_t i = 0; i < alpha.size(); ++i) values.push_back(f(i));
    return values;
  }
  std::vector<Exact> all(Exact k) const { return std::vector<Exact>(alpha.size(), k); }
};

Exact sum(const std::vector<Exact>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0L);
}
Exact median(std::vector<Exact> values) {
  std::ranges::sort(values);
  return 0.5L * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
}
Exact geometric_mean(const std::vector<Exact>& values) {
  Exact logs = 0.0L;
  for (const Exact v : values) logs += std::log(v);
  return std::exp(logs / static_cast<Exact>(values.size()));
}

struct Case {
  const char* text;
  std::function<std::vector<Exact>(const Quantities&)> expected;
};

using Q = const Quantities&;

const std::vector<Case> cases = {
    {"0.25", [](Q q) { return q.all(0.25L); }},
    {"sigma2 * trace / n", [](Q q) { return q.all(q.sigma2 * q.trace / q.n); }},
    {"1 - 2 - 3", [](Q q) { return q.all(-4.0L); }},
    {"64 / 4 / 2 * n", [](Q q) { return q.all(8.0L * q.n); }},
    {"1 + 2 * n ^ 2", [](Q q) { return q.all(1.0L + 2.0L * q.n * q.n); }},
    {"-n ^ 2", [](Q q) { return q.all(-q.n * q.n); }},
    {"n ^ -1 ^ 2", [](Q q) { return q.all(1.0L / q.n); }},  // n^(-(1^2))
    {"p ^ 2 ^ 3", [](Q q) { return q.all(std::pow(q.p, 8.0L)); }},
    {"(-n) ^ 3 - -n", [](Q q) { return q.all(-q.n * q.n * q.n + q.n); }},
    {"\t2*\n( sigma2+ .5e1 )\r\n/ +p ", [](Q q) { return q.all(2.0L * (q.sigma2 + 5.0L) / q.p); }},
    {"sigma2 / alpha ^ 2",
     [](Q q) { return q.each([&](std::size_t i) { return q.sigma2 / (q.alpha[i] * q.alpha[i]); }); }},
    {"abs(gradient - squares * alpha)",
     [](Q q) { return q.each([&](std::size_t i) { return std::fabs(q.gradient[i] - q.squares * q.alpha[i]); }); }},
    {"diagonal * 0.5 ^ iteration",
     [](Q q) { return q.each([&](std::size_t i) { return q.diagonal[i] * std::pow(0.5L, q.iteration); }); }},
    {"sqrt(diagonal) + diagonal ^ 0.5 * diagonal ^ -0.5 + diagonal ^ -3 + diagonal ^ 1.7 + diagonal ^ p",
     [](Q q) {
       return q.each([&](std::size_t i) {
         const Exact d = q.diagonal[i];
         return std::sqrt(d) + 1.0L + std::pow(d, -3.0L) + std::pow(d, 1.7L) + std::pow(d, q.p);
       });
     }},
    {"log(diagonal) * exp(-diagonal)",
     [](Q q) { return q.each([&](std::size_t i) { return std::log(q.diagonal[i]) * std::exp(-q.diagonal[i]); }); }},
    {"min(alpha, 0.1, gradient) + max(alpha, 0.2)",
     [](Q q) {
       return q.each([&](std::size_t i) {
         return std::min({q.alpha[i], 0.1L, q.gradient[i]}) + std::max(q.alpha[i], 0.2L);
       });
     }},
    {"sum(alpha)", [](Q q) { return q.all(sum(q.alpha)); }},
    {"mean(alpha)", [](Q q) { return q.all(sum(q.alpha) / q.p); }},
    {"median(alpha)", [](Q q) { return q.all(median(q.alpha)); }},
    {"geomean(diagonal)", [](Q q) { return q.all(geometric_mean(q.diagonal)); }},
    {"min(alpha)", [](Q q) { return q.all(std::ranges::min(q.alpha)); }},
    {"max(alpha) * alpha",
     [](Q q) { return q.each([&](std::size_t i) { return std::ranges::max(q.alpha) * q.alpha[i]; }); }},
    {"sum(alpha^2) / sum(alpha^2 * diagonal)",
     [](Q q) {
       return q.all(sum(q.each([&](std::size_t i) { return q.alpha[i] * q.alpha[i]; })) /
                    sum(q.each([&](std::size_t i) { return q.alpha[i] * q.alpha[i] * q.diagonal[i]; })));
     }},
};

template <std::size_t P>
void check_cases() {
  std::mt19937_64 engine(P);
  for (int trial = 0; trial < 50; ++trial) {
    const Problem<P> problem(engine);
    const Quantities quantities(problem);
    for (const Case& c : cases) {
      const auto k = problem.formula(c.text);
      const auto expected = c.expected(quantities);
      INFO(c.text << " of " << P << " unknowns");
      // Differences of numbers of size 10 that come near zero.
      for (std::size_t i = 0; i < P; ++i)
        CHECK(k[i] == Approx(static_cast<double>(expected[i])).epsilon(1e-13).margin(1e-13));
    }
  }
}

/// Estimators of the program, written as formulas.
const std::vector<std::array<const char*, 2>> written = {
    {"kibria_gm", "geomean(sigma2 / alpha^2)"},
    {"kibria_am", "mean(sigma2 / alpha^2)"},
    {"kibria_med", "median(sigma2 / alpha^2)"},
    {"hk", "sigma2 / alpha^2"},
    {"hk_max", "sigma2 / max(alpha^2)"},
    {"hkb", "p * sigma2 / sum(alpha^2)"},
    {"thisted", "(p - 2) * sigma2 / sum(alpha^2)"},
    {"lawless_wang", "p * sigma2 / sum(eigenvalues * alpha^2)"},
    {"khalaf_shukur", "max(eigenvalues) * sigma2 / ((n - p) * sigma2 + max(eigenvalues) * max(alpha^2))"},
    {"mk2", "max(sqrt(alpha^2 / max(sigma2, 1e-18)))"},
    {"mk3", "max(sqrt(sigma2 / alpha^2))"},
    {"mk4", "geomean((sigma2 / alpha^2)^-0.5)"},
    {"mk5", "geomean(sqrt(sigma2 / alpha^2))"},
    {"mk6", "median(abs(alpha) * sigma2^-0.5)"},
    {"fixed", "0.2"},
};

template <std::size_t P>
void check_written() {
  std::mt19937_64 engine(10 * P);
  for (int trial = 0; trial < 200; ++trial) {
    const Problem<P> problem(engine);
    for (const auto& [name, text] : written) {
      for (const auto coordinates : {solvers::RidgeCoordinates::Raw, solvers::RidgeCoordinates::Canonical}) {
        solvers::SolverOptions options;
        options.k_fixed = 0.2;
        options.ridge_coordinates = coordinates;
        options.k_formula = solvers::compile_k(text);
        const auto built_in = problem.k(name, options);
        const auto formula = problem.k("expr", options);
        INFO(name << " as " << text << " of " << P << " unknowns");
        // b'J'WJ b is a sum over eigenvalues only to the accuracy of these.
        const double size =
            std::fabs(*std::ranges::max_element(built_in.upper, {}, [](double x) { return std::fabs(x); }));
        const double tolerance = (std::string_view(name) == "lawless_wang" ? 1e-12 : 2e-15) * size;
        for (std::size_t i = 0; i < built_in.upper.size(); ++i)
          CHECK(std::fabs(formula.upper[i] - built_in.upper[i]) <= tolerance);
      }
    }
  }
}

}  // namespace

TEST_CASE("a formula of K is what its text says") {
  check_cases<2>();
  check_cases<3>();
  check_cases<4>();
}

TEST_CASE("estimators of K that are written as formulas are these estimators to rounding") {
  check_written<2>();
  check_written<3>();
  check_written<4>();
}

TEST_CASE("alpha is 1e-9 m long at least and keeps its sign") {
  CHECK(value("min(alpha)", -1e-12, 1.0) == -1e-9);
  CHECK(value("min(alpha)", 0.0, 1.0) == 1e-9);
  CHECK(value("max(alpha)", -3.0, -2.0) == -2.0);
}

TEST_CASE("a formula that names eigenvalues is in canonical coordinates, with all that it names") {
  // J'WJ = [2 1; 1 2] has eigenvalues 3 along (1, 1) and 1 along (1, -1), up to sign.
  std::mt19937_64 engine(1);
  Problem<2> problem(engine);
  problem.matrix(0, 0) = problem.matrix(1, 1) = 2.0;
  problem.matrix(0, 1) = 1.0;
  problem.step = {1.0, 0.5};
  problem.gradient = {4.0, 1.0};
  const auto sum = [&](const char* text) { return problem.formula(text)[0]; };
  CHECK(sum("sum(eigenvalues * alpha^2)") == Approx(3.0 * 1.125 + 1.0 * 0.125));
  CHECK(sum("sum(eigenvalues * gradient^2)") == Approx(3.0 * 12.5 + 1.0 * 4.5));
  CHECK(sum("sum((eigenvalues - diagonal)^2)") == 0.0);
  CHECK(sum("trace - sum(eigenvalues)") == Approx(0.0).margin(1e-15));
  // K = Q diag(l) Q' is J'WJ itself.
  solvers::SolverOptions options;
  options.k_formula = solvers::compile_k("eigenvalues");
  const auto k = problem.k("expr", options);
  CHECK(k(0, 0) == Approx(2.0));
  CHECK(k(0, 1) == Approx(1.0));
  CHECK(k(1, 1) == Approx(2.0));
  // In the coordinates that the options say otherwise.
  options.k_formula = solvers::compile_k("sum(abs(alpha))");
  CHECK(problem.k("expr", options)(0, 0) == Approx(1.5));
  options.ridge_coordinates = solvers::RidgeCoordinates::Canonical;
  CHECK(problem.k("expr", options)(0, 0) == Approx(std::sqrt(1.125) + std::sqrt(0.125)));
}

TEST_CASE("the median of what is not a number is not one, wherever it stands") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  using Three = core::Vector<double, 3>;
  CHECK(solvers::formula_median(Three{3.0, 1.0, 2.0}) == 2.0);
  for (const Three& values : {Three{nan, 1.0, 2.0}, Three{1.0, nan, 2.0}, Three{1.0, 2.0, nan}})
    CHECK(std::isnan(solvers::formula_median(values)));
}

TEST_CASE("anything to the power 0 is 1, be it known early or late") {
  for (const double x : {0.0, 2.0, -2.0, infinity}) CHECK(solvers::formula_power(x, 0.0) == 1.0);
  for (const char* text : {"0 ^ 0", "0 ^ (n - n)"}) CHECK(value(text) == 1.0);
}

TEST_CASE("functions of formulas know what to make of any number") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double tiny = std::numeric_limits<double>::denorm_min();
  struct Special {
    const char* text;
    double x;
    double expected;
  };
  // value() puts x into alpha, whose floor 1e-9 keeps zero away: 1 / x is zero where x is infinite.
  for (const Special& s : std::initializer_list<Special>{
           {"max(log(alpha))", infinity, infinity},
           {"min(log(1 / alpha))", infinity, -infinity},
           {"sum(log(alpha))", -1.0, nan},
           {"sum(log(alpha))", nan, nan},
           {"max(exp(alpha))", 709.0, infinity},
           {"max(exp(alpha))", 708.0, std::exp(708.0)},
           {"min(exp(alpha))", -709.0, 0.0},
           {"min(exp(alpha))", -infinity, 0.0},
           {"max(exp(alpha))", infinity, infinity},
           {"sum(exp(alpha))", nan, nan},
           {"sum(sqrt(alpha))", -1.0, nan},
           {"max(sqrt(alpha))", infinity, infinity},
           {"max(sqrt(alpha))", 0x1p1022, 0x1p511},
           {"min(sqrt(1 / alpha))", 0x1p1022, 0x1p-511},
           {"min(sqrt(1 / alpha / 1e300 / 1e9 / 1e9))", 1.0, std::sqrt(1.0 / 1e300 / 1e9 / 1e9)},
           {"min(sqrt(1 / alpha))", infinity, 0.0},
           {"sum(max(alpha, 2))", nan, nan},
           {"sum(max(2, alpha))", nan, nan},
           {"sum(min(alpha, 2))", nan, nan},
           {"sum(min(2, alpha))", nan, nan},
           {"geomean(1 / alpha)", infinity, 0.0},
           {"geomean(alpha)", infinity, infinity},
           {"geomean(alpha)", -1.0, nan},
           {"geomean(alpha * 1e300)", 1e8, std::sqrt(1e8) * 1e300},
           {"sum(alpha ^ 0)", 7.0, 2.0},
           {"sum(alpha ^ 1.5)", -1.0, nan},
       }) {
    INFO(s.text << " of " << s.x);
    const double found = value(s.text, s.x);
    if (std::isnan(s.expected)) {
      CHECK(std::isnan(found));
    } else {
      CHECK(found == Approx(s.expected).epsilon(2e-13));
    }
  }
  // Square roots are correctly rounded, over all exponents.
  std::mt19937_64 engine(3);
  for (int i = 0; i < 10'000; ++i) {
    const double x = std::ldexp(uniform(engine, 1.0, 2.0), static_cast<int>(uniform(engine, -1074.0, 1023.9)));
    CHECK(solvers::formula_sqrt(x) == std::sqrt(x));
  }
  CHECK(solvers::formula_sqrt(tiny) == std::sqrt(tiny));
  CHECK(solvers::formula_sqrt(0.0) == 0.0);
}

TEST_CASE("numbers of formulas are folded as the formula would compute them, and only to finite ones") {
  CHECK(value("2 ^ 10 / 4 - 6") == 250.0);
  CHECK(value("(-2) ^ 3") == -8.0);
  CHECK(value("4 ^ -0.5") == 0.5);
  CHECK(value("sqrt(2) * sqrt(2)") == std::sqrt(2.0) * std::sqrt(2.0));
  CHECK(value("min(3, 2, 4) + max(1, 5)") == 7.0);
  CHECK(value("2 ^ 0.3") == Approx(std::pow(2.0, 0.3)).epsilon(1e-15));
  const auto formula = solvers::compile_k("2 * 3 + 1");
  CHECK(static_cast<int>(formula.size) == 1);
  CHECK(formula.constants[0] == 7.0);
}

TEST_CASE("options without a formula have the one that is 0") {
  CHECK(solvers::SolverOptions{}.k_formula.size == 1);
  std::mt19937_64 engine(1);
  CHECK(core::diagonal(Problem<2>(engine).k("expr", {})) == core::Vector<double, 2>{0.0, 0.0});
}
