// The solvers against Ceres, the independent reference. RIDGELOC_AGREEMENT_TRIALS is set by the build: few trials among
// the unit tests, 10^5 among the slow ones.

#include <cstdio>

#include "catch.hpp"
#include "tests/solvers/agreement.hpp"

using namespace ridgeloc::tests;

namespace {

constexpr std::size_t trials = RIDGELOC_AGREEMENT_TRIALS;

}  // namespace

TEST_CASE("ols and lm, run to the end, meet the minimiser of Ceres") {
  const std::size_t points = GENERATE(3, 5, 7);
  for (const char* solver : {"ols", "lm"}) {
    const Agreement a = compare_with_ceres(solver, trials, points, 0.1);
    std::printf("%s, %zu points: %zu trials, %zu converged, %zu with reference, %zu in its basin, %zu well conditioned: "
                "largest gap %.3g m, largest gradient %.3g of its bound\n",
                solver, points, a.trials, a.converged, a.reference, a.same_basin, a.conditioned, a.largest_gap_m,
                a.largest_gradient);
    CHECK(a.largest_gap_m <= 1e-8);
    CHECK(a.largest_gradient <= 1.0);
    CHECK(a.same_basin > trials / 2);
    CHECK(a.conditioned > a.same_basin * 8 / 10);
  }
}

TEST_CASE("rr and rrr stay where Ceres' minimiser is, whatever K") {
  const std::size_t points = GENERATE(3, 5, 7);
  for (const char* solver : {"rr", "rrr"}) {
    for (const StepAtMinimizer& s : steps_at_minimizer(solver, trials, points, 0.1)) {
      std::printf("%s with %s, %zu points: %zu of %zu with reference, %zu singular there, largest step %.3g m, %.3g of "
                  "what rounding allows\n",
                  solver, s.k.c_str(), points, s.reference, s.trials, s.singular, s.largest_step_m, s.largest_ratio);
      CHECK(s.largest_ratio <= 1.0);
      CHECK(s.reference > trials * 9 / 10);
      // Where three ranges have no common point, J'e = 0 with e != 0 needs a singular J: about one trial in eight.
      CHECK(s.singular <= (points == 3 ? s.reference / 4 : 0));
    }
  }
}
