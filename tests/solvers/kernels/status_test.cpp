#include <cmath>
#include <limits>

#include "tests/support/catch.hpp"
#include "tests/support/hand_scene.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

const char* const all_solvers[] = {"ols", "lm", "rr", "rrr"};
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

TEST_CASE("exact measurements lead every solver to the truth") {
  const std::vector<Point> points = {{3, 0, 1}, {4, 3, -1}, {5, -2, 2}, {6, 1, -3}, {2, -1, -1}};
  std::vector<double> measured;
  for (const Point& p : points) measured.push_back(distance(p, {0.2, 0.1, -0.1}));
  solvers::SolverOptions options;
  options.step_tolerance_m = 1e-9;
  options.max_iterations = 1000;
  for (const char* solver : all_solvers) {
    INFO(solver);
    const auto s = solve(solver, problem(points, measured, {1.0, 0.5, 0.5}), options);
    CHECK(status(s) == core::Status::Converged);
    CHECK(distance(estimate(s), {0.2, 0.1, -0.1}) < 1e-8);
    CHECK(s.residual_rms_m[0] < 1e-8);
    CHECK(s.remaining_step_m[0] < 1e-8);
  }
}

TEST_CASE("the step that meets the stop rule is applied and counted") {
  solvers::SolverOptions options;
  options.step_tolerance_m = 0.5;
  const auto s = solve("ols", axes_problem(0.1, -0.2, 0.3), options);
  CHECK(status(s) == core::Status::Converged);
  CHECK(s.iterations[0] == 1.0);
  CHECK(distance(estimate(s), {0.1, -0.2, 0.3}) < 1e-15);
}

TEST_CASE("points on one line make the normal matrix singular") {
  const auto p = problem({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, {1.1, 2.1, 3.2, 4.0}, {0, 0, 0});
  for (const char* solver : all_solvers) {
    INFO(solver);
    const auto s = solve(solver, p);
    CHECK(status(s) == core::Status::Singular);
    CHECK(s.iterations[0] == 0.0);
    CHECK(estimate(s) == Point{0, 0, 0});
  }
  // A ridge that needs no least-squares step makes the same problem solvable.
  solvers::SolverOptions options;
  options.k = k_index("fixed");
  options.k_fixed = 1.0;
  CHECK(status(solve("rr", p, options)) == core::Status::Converged);
}

TEST_CASE("input that is not finite, and a start on a point, end as non_finite") {
  for (const char* solver : all_solvers) {
    INFO(solver);
    for (const double bad : {not_a_number, infinity, -infinity}) {
      CHECK(status(solve(solver, problem({{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {bad, 2, 2}, {0, 0, 0}))) ==
            core::Status::NonFinite);
      CHECK(status(solve(solver, problem({{bad, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {2, 2, 2}, {0, 0, 0}))) ==
            core::Status::NonFinite);
      CHECK(status(solve(solver, problem({{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {2, 2, 2}, {0, bad, 0}))) ==
            core::Status::NonFinite);
    }
    const auto on_point = solve(solver, problem({{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {2, 2, 2}, {2, 0, 0}));
    CHECK(status(on_point) == core::Status::NonFinite);
    CHECK(estimate(on_point) == Point{2, 0, 0});
  }
}

TEST_CASE("an estimate that runs away has left the domain") {
  // Directions that differ by 1e-6 turn residuals of 10 m into a step of 10^7 m.
  const auto p = problem({{2, 0, 0}, {2, 2e-6, 0}, {2, 0, 2e-6}}, {2, 12, -8}, {0, 0, 0});
  CHECK(status(solve("ols", p)) == core::Status::LeftDomain);
}

TEST_CASE("the iteration limit is a status") {
  const auto s = solve("ols", axes_problem(0.1, -0.2, 0.3), steps(2));
  CHECK(status(s) == core::Status::IterationLimit);
  CHECK(s.iterations[0] == 2.0);
}

TEST_CASE("the remaining step is the undamped one at the estimate, with the solver's own weights") {
  solvers::SolverOptions options = steps(1);
  options.k = k_index("fixed");
  options.k_fixed = 1e12;  // holds x at the origin to 1e-12
  const auto p = problem({{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {-2, 0, 0}}, {1.9, 2.1, 1.99, 2.5}, {0, 0, 0});
  // rr: e = (0.1, -0.1, 0.01, -0.5), J'J = diag(2, 1, 1), J'e = (-0.6, 0.1, -0.01).
  CHECK(solve("rr", p, options).remaining_step_m[0] == Approx(std::hypot(0.3, 0.1, 0.01)).epsilon(1e-9));
  // rrr: w = (10, 10, 20, 2), J'WJ = diag(12, 10, 20), J'We = (-2, 1, -0.2).
  CHECK(solve("rrr", p, options).remaining_step_m[0] == Approx(std::hypot(1.0 / 6.0, 0.1, 0.01)).epsilon(1e-9));
  CHECK(solve("rr", p, options).residual_rms_m[0] ==
        Approx(std::sqrt((0.01 + 0.01 + 0.0001 + 0.25) / 4.0)).epsilon(1e-9));
  // On a line of points nothing is known across it.
  CHECK(solve("rr", problem({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {1, 2, 3}, {0, 0, 0}), options).remaining_step_m[0] ==
        infinity);
}

TEST_CASE("a trial's answer does not depend on its neighbours") {
  const std::vector<Point> points = {{3, 0, 1}, {4, 3, -1}, {5, -2, 2}, {6, 1, -3}};
  const std::vector<double> measured = {3.2, 5.0, 5.8, 6.7};
  core::ProblemBatch batch;
  batch.reshape(points.size(), 3);
  for (std::size_t t = 0; t < 3; ++t) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      for (std::size_t axis = 0; axis < 3; ++axis) batch.position(j, axis)[t] = t == 1 ? not_a_number : points[j][axis];
      batch.measured(j)[t] = measured[j];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) batch.start(axis)[t] = 1.0;
  }
  for (const char* solver : all_solvers) {
    INFO(solver);
    const auto together = solve(solver, batch);
    const auto alone = solve(solver, problem(points, measured, {1, 1, 1}));
    for (const std::size_t t : {0, 2}) {
      CHECK(estimate(together, t) == estimate(alone));
      CHECK(together.iterations[t] == alone.iterations[0]);
    }
    CHECK(status(together, 1) == core::Status::NonFinite);
  }
}
