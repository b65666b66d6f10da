// Estimators of K on values worked out by hand.

#include <cmath>
#include <string_view>

#include "solvers/estimators/k_kernels.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hand_scene.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

template <std::size_t P>
using Vector = core::Vector<double, P>;

/// A context with a diagonal J'WJ: canonical coordinates are the unknowns.
template <std::size_t P>
struct Hand {
  Vector<P> eigenvalues;
  Vector<P> step;
  double sigma2 = 0.01;
  double squares = 0.0;
  std::size_t observations = P + 2;
  const solvers::TrialOracle<double, P>* oracle = nullptr;
  Vector<P> u{};

  Vector<P> k(std::string_view name, const solvers::SolverOptions& options = {}) const {
    solvers::KContext<double, P> c{{}, step, squares, sigma2, {}, {}, u, 0.0, observations, oracle, options};
    for (std::size_t i = 0; i < P; ++i) c.least_squares.matrix(i, i) = eigenvalues[i];
    solvers::RidgeMatrix<double, P> out;
    solvers::k_kernel<double, P> (*solvers::find_k_estimator(name))(c, out);
    for (std::size_t i = 0; i < P; ++i) {
      for (std::size_t j = 0; j < i; ++j) CHECK(out(i, j) == 0.0);
    }
    return core::diagonal(out);
  }
  /// The one k of estimators that have one.
  double scalar(std::string_view name, const solvers::SolverOptions& options = {}) const {
    const Vector<P> all = k(name, options);
    for (const double one : all) CHECK(one == all[0]);
    return all[0];
  }
};

/// alpha_i^2 = 0.01, 0.04, 0.16, so that sigma2 / alpha_i^2 = 1, 1/4, 1/16 and m_i = 1, 1/2, 1/4.
const Hand<3> three{{1.0, 2.0, 4.0}, {0.1, -0.2, 0.4}};
const Hand<2> two{{1.0, 2.0}, {0.1, -0.2}};
const Hand<4> four{{1.0, 2.0, 4.0, 8.0}, {0.1, -0.2, 0.4, 0.8}};

const char* const learning[] = {"kibria_gm",    "kibria_am",     "kibria_med", "hk",  "hk_max", "hkb", "thisted",
                                "lawless_wang", "khalaf_shukur", "mk2",        "mk3", "mk4",    "mk5", "mk6",
                                "gcv"};

}  // namespace

TEST_CASE("estimators of K of three unknowns") {
  for (const auto coordinates : {solvers::RidgeCoordinates::Raw, solvers::RidgeCoordinates::Canonical}) {
    solvers::SolverOptions options;
    options.ridge_coordinates = coordinates;
    const auto is = [](double value) { return Approx(value).epsilon(1e-14); };
    const Vector<3> hk = three.k("hk", options);
    CHECK(hk[0] == is(1.0));
    CHECK(hk[1] == is(0.25));
    CHECK(hk[2] == is(0.0625));
    CHECK(three.scalar("hk_max", options) == is(0.0625));
    CHECK(three.scalar("hkb", options) == is(1.0 / 7.0));            // 3 * 0.01 / 0.21
    CHECK(three.scalar("thisted", options) == is(1.0 / 21.0));       // 1 * 0.01 / 0.21
    CHECK(three.scalar("lawless_wang", options) == is(3.0 / 73.0));  // 0.03 / (0.01 + 0.08 + 0.64)
    CHECK(three.scalar("kibria_am", options) == is(0.4375));         // 1.3125 / 3
    CHECK(three.scalar("kibria_gm", options) == is(0.25));           // (1/64)^(1/3)
    CHECK(three.scalar("kibria_med", options) == is(0.25));
    CHECK(three.scalar("khalaf_shukur", options) == is(2.0 / 33.0));  // 4 * 0.01 / (2 * 0.01 + 4 * 0.16)
    CHECK(three.scalar("mk2", options) == is(4.0));
    CHECK(three.scalar("mk3", options) == is(1.0));
    CHECK(three.scalar("mk4", options) == is(2.0));
    CHECK(three.scalar("mk5", options) == is(0.5));
    CHECK(three.scalar("mk6", options) == is(2.0));
    options.k_fixed = 0.7;
    CHECK(three.scalar("fixed", options) == 0.7);
  }
}

TEST_CASE("estimators of K of two and of four unknowns") {
  const auto is = [](double value) { return Approx(value).epsilon(1e-14); };
  CHECK(two.scalar("hkb") == is(0.4));  // 2 * 0.01 / 0.05
  CHECK(two.scalar("thisted") == 0.0);
  CHECK(two.scalar("lawless_wang") == is(2.0 / 9.0));  // 0.02 / (0.01 + 0.08)
  CHECK(two.scalar("kibria_am") == is(0.625));
  CHECK(two.scalar("kibria_gm") == is(0.5));
  CHECK(two.scalar("kibria_med") == is(0.625));
  CHECK(two.scalar("mk4") == is(std::sqrt(2.0)));
  CHECK(two.scalar("mk6") == is(1.5));
  // sigma2 / alpha_i^2 = 1, 1/4, 1/16, 1/64.
  CHECK(four.scalar("hk_max") == is(1.0 / 64.0));
  CHECK(four.scalar("hkb") == is(0.04 / 0.85));
  CHECK(four.scalar("thisted") == is(0.02 / 0.85));
  CHECK(four.scalar("lawless_wang") == is(0.04 / 5.85));  // 0.73 + 8 * 0.64
  CHECK(four.scalar("kibria_gm") == is(0.125));
  CHECK(four.scalar("kibria_med") == is(0.15625));
  CHECK(four.scalar("mk4") == is(std::exp2(1.5)));
  CHECK(four.scalar("mk5") == is(std::exp2(-1.5)));
  CHECK(four.scalar("mk6") == is(3.0));
}

TEST_CASE("gcv finds the minimum that equal eigenvalues allow to work out") {
  // With J'WJ = I, s = k / (1 + k), F = |dx|^2 = 0.21 and R the residual sum of squares, the score is
  // (R + F s^2) / (n - p + p s)^2, least at s = p R / ((n - p) F): for R = 0.035, n - p = 2 it is 1/4, and k = 1/3.
  Hand<3> hand{{1.0, 1.0, 1.0}, {0.1, -0.2, 0.4}};
  hand.squares = 0.21 + 0.035;
  // Golden section ends 0.5 * 0.618^18 decades wide, 2e-4 of k; we are in the middle.
  CHECK(hand.scalar("gcv") == Approx(1.0 / 3.0).epsilon(1e-4));
  // Ranges that fit exactly want no ridge: the lower end of the grid, 10^-8 l_max, or a quarter decade below.
  hand.squares = 0.21;
  CHECK(hand.scalar("gcv") < 1e-8);
  // A fit that explains nothing wants as much as there is.
  hand.squares = 1e6;
  CHECK(hand.scalar("gcv") > 1e4);
}

TEST_CASE("gcv at as many observations as unknowns is not led astray by what rounding leaves of the residual") {
  // The score (F_1 s_1^2 + F_2 s_2^2) / (s_1 + s_2)^2, F_i = l_i alpha_i^2, s_i = k / (l_i + k), is least where
  // s_2 / s_1 = F_1 / F_2: for l = 4, 1 and F_1 / F_2 = 4 - d at k = d / (3 - d).
  for (const double k : {1e-6, 1e-4, 1e-2, 1.0, 100.0}) {
    const double d = 3.0 * k / (1.0 + k);
    Hand<2> hand{{4.0, 1.0}, {std::sqrt((4.0 - d) / 4.0), 1.0}};
    hand.observations = 2;
    const double fitted = 4.0 * hand.step[0] * hand.step[0] + hand.step[1] * hand.step[1];
    for (const double rounding : {0.0, 1e-16, 1e-15, 1e-12}) {
      INFO("k " << k << ", rounding " << rounding);
      hand.squares = fitted * (1.0 + rounding);
      // Near its minimum the score is 1 + (k' - k)^2 / 4 of it and less steep: rounding hides 2 sqrt(eps) = 3e-8, the
      // search ends 2e-4 of k wide.
      CHECK(hand.scalar("gcv") == Approx(k).epsilon(k < 1e-5 ? 0.1 : 1e-3));
    }
  }
}

TEST_CASE("a component of zero length counts as a nanometre") {
  Hand<3> hand = three;
  hand.step[1] = 0.0;
  CHECK(hand.k("hk")[1] == Approx(1e16).epsilon(1e-14));  // 0.01 / 10^-18
  CHECK(hand.scalar("hk_max") == Approx(0.0625).epsilon(1e-14));
  CHECK(hand.scalar("kibria_am") == Approx(1e16 / 3.0).epsilon(1e-14));
  CHECK(hand.scalar("kibria_gm") == Approx(std::cbrt(0.0625e16)).epsilon(1e-14));
  CHECK(hand.scalar("kibria_med") == Approx(1.0).epsilon(1e-14));
  CHECK(hand.scalar("mk3") == Approx(1e8).epsilon(1e-14));
  hand.step = {0.0, 0.0, 0.0};
  CHECK(hand.scalar("lawless_wang") == Approx(0.03e18).epsilon(1e-14));
  for (const char* name : learning) {
    for (const double k : hand.k(name)) CHECK((k >= 0.0 && std::isfinite(k)));
  }
}

TEST_CASE("without noise k is zero, or as if sigma were a nanometre where its inverse counts") {
  Hand<3> hand = three;
  hand.sigma2 = 0.0;
  for (const char* name :
       {"kibria_gm", "kibria_am", "kibria_med", "hk_max", "hkb", "thisted", "lawless_wang", "khalaf_shukur"}) {
    INFO(name);
    CHECK(hand.scalar(name) == 0.0);
  }
  // m_i = 10^-9 / |alpha_i| = 10^-8, 0.5 * 10^-8, 0.25 * 10^-8.
  CHECK(hand.scalar("mk2") == Approx(4e8).epsilon(1e-14));
  CHECK(hand.scalar("mk3") == Approx(1e-8).epsilon(1e-14));
  CHECK(hand.scalar("mk4") == Approx(2e8).epsilon(1e-14));
  CHECK(hand.scalar("mk5") == Approx(0.5e-8).epsilon(1e-14));
  CHECK(hand.scalar("mk6") == Approx(2e8).epsilon(1e-14));
  hand.step = {0.0, 0.0, 0.0};
  for (const char* name : learning) {
    INFO(name);
    for (const double k : hand.k(name)) CHECK((k >= 0.0 && std::isfinite(k)));
  }
}

TEST_CASE("oracles know sigma^2 over the squared error, and are as similar to it as they are told to be") {
  const auto check = [](auto hand, const auto& expected, double geometric_mean) {
    constexpr std::size_t P = std::tuple_size_v<decltype(hand.step)>;
    const solvers::TrialOracle<double, P> oracle{{}, 0.01, core::Stream(1, "k_error"), 7};
    hand.u = hand.step;
    hand.oracle = &oracle;
    for (std::size_t i = 0; i < P; ++i) CHECK(hand.k("oracle_elem")[i] == Approx(expected[i]).epsilon(1e-14));
    CHECK(hand.scalar("oracle_gm") == Approx(geometric_mean).epsilon(1e-14));
    for (const double eta : {0.2, 0.6, 0.9}) {
      for (const auto sign : {solvers::KError::Signed, solvers::KError::Positive}) {
        solvers::SolverOptions options;
        options.similarity = eta;
        options.k_error = sign;
        const Vector<P> k = hand.k("oracle_elem", options);
        double squared = 0.0;
        for (std::size_t i = 0; i < P; ++i) {
          squared += (k[i] - expected[i]) * (k[i] - expected[i]);
          CHECK((sign == solvers::KError::Signed || k[i] >= expected[i]));
        }
        CHECK(1.0 / (1.0 + std::sqrt(squared)) == Approx(eta).epsilon(1e-13));
      }
    }
  };
  check(two, Vector<2>{1.0, 0.25}, 0.5);
  check(three, Vector<3>{1.0, 0.25, 0.0625}, 0.25);
  check(four, Vector<4>{1.0, 0.25, 0.0625, 0.015625}, 0.125);
}
