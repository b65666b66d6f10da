#include <algorithm>
#include <cmath>
#include <limits>

#include "core/random.hpp"
#include "solvers/estimators/k_oracle.hpp"
#include "solvers/estimators/true_k.hpp"
#include "solvers/kernels/iteration.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hand_scene.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

/// Truth at the origin for any number of trials.
struct Origin {
  std::vector<double> zeros;
  core::Oracle oracle;

  Origin(std::size_t trials, double sigma_m) : zeros(trials, 0.0) {
    for (auto& axis : oracle.truth) axis = zeros;
    oracle.range_sigma_m = sigma_m;
    oracle.k_error = core::Stream(2018, "k_error");
  }

  solvers::TrialOracle<double, 3> of(std::size_t trial) const {
    return {{0.0, 0.0, 0.0}, oracle.range_sigma_m * oracle.range_sigma_m, oracle.k_error, oracle.first_trial + trial};
  }
};

solvers::KContext<double, 3> context(const solvers::TrialOracle<double, 3>& oracle,
                                     const solvers::SolverOptions& options, const Point& x, int iteration) {
  return {{}, {}, 0.0, 0.0, {}, {}, x, static_cast<double>(iteration), 5, &oracle, options};
}

}  // namespace

TEST_CASE("the true K is sigma^2 over the squared error, by component or as geometric mean") {
  const Origin origin(1, 0.1);
  const Point x{0.1, -0.5, 2.0};
  const auto elem = solvers::true_k(solvers::KTrue::Elem, x, origin.of(0));
  CHECK(elem[0] == Approx(1.0));
  CHECK(elem[1] == Approx(0.04));
  CHECK(elem[2] == Approx(0.0025));
  const auto gm = solvers::true_k(solvers::KTrue::Gm, x, origin.of(0));
  CHECK(gm[0] == Approx(std::cbrt(1.0 * 0.04 * 0.0025)));
  CHECK(gm[0] == gm[1]);
  CHECK(gm[0] == gm[2]);
  const auto at_truth = solvers::true_k<double, 3>(solvers::KTrue::Elem, {0, 1, 1}, origin.of(0));
  CHECK(at_truth[0] == Approx(0.01 / 1e-18));
}

TEST_CASE("similarity is 1 for equal parameters and falls with their distance") {
  using solvers::Eta;
  CHECK(solvers::similarity<double, 3>(Eta::Squared, {1, 2, 3}, {1, 2, 3}) == 1.0);
  CHECK(solvers::similarity<double, 3>(Eta::Squared, {4, 2, 7}, {1, 2, 3}) == Approx(1.0 / 6.0));
  CHECK(solvers::similarity<double, 3>(Eta::Absolute, {4, 2, 7}, {1, 4, 3}) == Approx(1.0 / (1.0 + std::sqrt(5.0))));
  CHECK(solvers::similarity<double, 3>(Eta::Absolute, {1, 4, 3}, {4, 2, 7}) == Approx(1.0 / (1.0 + std::sqrt(5.0))));
}

TEST_CASE("a perturbed K has the similarity asked for, to rounding") {
  const std::size_t trials = 2000;
  const Origin origin(trials, 0.1);
  solvers::SolverOptions options;
  double worst = 0.0;
  for (const double eta : {1.0, 0.9, 0.6, 0.1, 0.001}) {
    for (const auto sign : {solvers::KError::Signed, solvers::KError::Positive}) {
      options.similarity = eta;
      options.k_error = sign;
      for (std::size_t t = 0; t < trials; ++t) {
        // Errors from a nanometre, where K' is 10^16, to ten metres.
        const double size = std::pow(10.0, -9.0 + 10.0 * static_cast<double>(t) / trials);
        const Point x{size, -0.3 * size, 2.0 * size};
        const solvers::TrialOracle<double, 3> known = origin.of(t);
        const auto c = context(known, options, x, static_cast<int>(t % 30));
        const auto k_true = solvers::true_k(solvers::KTrue::Elem, x, origin.of(t));
        const double achieved = solvers::similarity(solvers::Eta::Squared, solvers::OracleElem{}(c), k_true);
        const double norm = std::hypot(k_true[0], k_true[1], k_true[2]);
        worst = std::max(worst, std::fabs(achieved - eta) / std::max(1.0, norm));
      }
    }
  }
  INFO("largest deviation " << worst / std::numeric_limits<double>::epsilon() << " eps max(1, |K'|)");
  CHECK(worst <= 8.0 * std::numeric_limits<double>::epsilon());
}

TEST_CASE("the direction of the error is drawn per iteration or per trial, of either sign or positive") {
  const Origin origin(2, 0.1);
  solvers::SolverOptions options;
  options.similarity = 0.5;
  const Point x{1, 1, 1};
  const auto k = [&](std::size_t trial, int iteration) {
    const solvers::TrialOracle<double, 3> known = origin.of(trial);
    return solvers::OracleElem{}(context(known, options, x, iteration));
  };
  CHECK(k(0, 0) != k(0, 1));
  CHECK(k(0, 0) != k(1, 0));
  CHECK(k(0, 5) == k(0, 5));
  options.k_error_draw = solvers::KErrorDraw::PerTrial;
  CHECK(k(0, 0) == k(0, 1));
  CHECK(k(0, 0) != k(1, 0));
  options.k_error_draw = solvers::KErrorDraw::PerIteration;
  bool negative = false;
  for (int i = 0; i < 30; ++i) negative = negative || std::ranges::min(k(0, i)) < 0.01;
  CHECK(negative);
  options.k_error = solvers::KError::Positive;
  for (int i = 0; i < 30; ++i) CHECK(std::ranges::min(k(0, i)) >= 0.01);
}

TEST_CASE("an oracle's K does not depend on where in a batch the trial lies") {
  Origin origin(10, 0.1);
  solvers::SolverOptions options;
  options.similarity = 0.7;
  const Point x{1, 1, 1};
  const solvers::TrialOracle<double, 3> seventh = origin.of(7);
  origin.oracle.first_trial = 5;
  const solvers::TrialOracle<double, 3> second_of_five = origin.of(2);
  CHECK(solvers::OracleGm{}(context(second_of_five, options, x, 3)) ==
        solvers::OracleGm{}(context(seventh, options, x, 3)));
}

TEST_CASE("eta is recorded at the first and last iteration and on average, where a truth is known") {
  const std::vector<Point> points = {{3, 0, 1}, {4, 3, -1}, {5, -2, 2}, {6, 1, -3}};
  const std::vector<double> measured = {3.2, 5.0, 5.8, 6.7};
  const auto p = problem(points, measured, {1, 2, 1.5});
  const Origin origin(1, 0.1);
  auto options = steps(2);
  options.k = k_index("fixed");
  options.k_fixed = 0.7;
  const auto eta_at = [&](const Point& x) {
    return solvers::similarity<double, 3>(solvers::Eta::Squared, {0.7, 0.7, 0.7},
                                          solvers::true_k(solvers::KTrue::Elem, x, origin.of(0)));
  };
  const double first = eta_at({1, 2, 1.5});
  const double second = eta_at(estimate(solve("rr", p, [&] {
    auto o = options;
    o.max_iterations = 1;
    return o;
  }())));
  const auto s = solve("rr", p, options, &origin.oracle);
  CHECK(s.eta_first[0] == first);
  CHECK(s.eta_last[0] == second);
  CHECK(s.eta_mean[0] == Approx((first + second) / 2.0));
  CHECK(std::isnan(solve("rr", p, options).eta_first[0]));
  CHECK(std::isnan(solve("ols", p, options, &origin.oracle).eta_first[0]));
}
