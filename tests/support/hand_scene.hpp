#pragma once

#include <array>
#include <cmath>
#include <vector>

#include "core/problem.hpp"
#include "core/solution.hpp"
#include "solvers/solver.hpp"
#include "tests/support/catch.hpp"

namespace ridgeloc::tests {

using Point = std::array<double, 3>;

/// One problem from points, measured ranges and a start.
inline core::ProblemBatch problem(const std::vector<Point>& points, const std::vector<double>& measured, Point start) {
  core::ProblemBatch batch;
  batch.reshape(points.size(), 1);
  for (std::size_t j = 0; j < points.size(); ++j) {
    for (std::size_t axis = 0; axis < 3; ++axis) batch.position(j, axis)[0] = points[j][axis];
    batch.measured(j)[0] = measured[j];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) batch.start(axis)[0] = start[axis];
  return batch;
}

/// Points two metres out on the axes, seen from the origin: the directions to them are minus the unit vectors, so
/// that J'J is the identity and everything can be worked out by hand.
inline core::ProblemBatch axes_problem(double e_x, double e_y, double e_z) {
  return problem({{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {2 - e_x, 2 - e_y, 2 - e_z}, {0, 0, 0});
}

inline core::SolutionBatch solve(const char* solver, const core::ProblemBatch& problems,
                                 const solvers::SolverOptions& options = {}, const core::Oracle* oracle = nullptr) {
  core::SolutionBatch solutions;
  const solvers::SolverEntry& entry = solvers::solver_named(solver);
  entry.solve(problems, options, oracle, solutions);
  // What is found out by hand about the double path holds for the kernels of the baseline, which give the same bits.
  core::SolutionBatch packed;
  entry.kernel(core::Isa::Baseline)(problems, options, oracle, packed);
  INFO(solver);
  CHECK(packed.status == solutions.status);
  CHECK(packed.iterations == solutions.iterations);
  return solutions;
}

inline Point estimate(const core::SolutionBatch& s, std::size_t trial = 0) {
  return {s.estimate[0][trial], s.estimate[1][trial], s.estimate[2][trial]};
}

inline double distance(const Point& a, const Point& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

inline core::Status status(const core::SolutionBatch& s, std::size_t trial = 0) {
  return static_cast<core::Status>(s.status[trial]);
}

/// Options for exactly `steps` steps.
inline solvers::SolverOptions steps(int count) {
  solvers::SolverOptions options;
  options.max_iterations = count;
  options.step_tolerance_m = 1e-15;
  return options;
}

inline std::size_t k_index(const char* name) {
  return *solvers::find_k_estimator(name);
}

}  // namespace ridgeloc::tests
