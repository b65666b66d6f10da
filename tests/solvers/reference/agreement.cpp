#include "tests/solvers/reference/agreement.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <string_view>

#include "sim/field_of_view.hpp"
#include "sim/range_noise.hpp"
#include "solvers/estimators/formula_compiler.hpp"
#include "solvers/models/weight.hpp"
#include "solvers/reference/ceres_reference.hpp"
#include "tests/support/hand_scene.hpp"

namespace ridgeloc::tests {

namespace {

constexpr double theta_m = 0.05;

core::ProblemBatch scenes(std::size_t trials, std::size_t points, double sigma_m) {
  const sim::FieldOfView view;
  core::ProblemBatch problems;
  problems.reshape(points, trials);
  sim::place_objects(view, sim::SceneStreams(2018, view), 0, problems);
  sim::measure_ranges(sim::noise_registry()[0], {.range_sigma_m = sigma_m}, core::Stream(2018, "noise"), 0, problems);
  return problems;
}

/// Eigenvalues of J'WJ at x, ascending.
Eigen::Vector3d eigenvalues(const core::ProblemBatch& problems, std::size_t trial, const Point& x, bool robust) {
  solvers::SolverOptions options;
  options.theta_m = theta_m;
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  for (std::size_t j = 0; j < problems.points(); ++j) {
    Eigen::Vector3d d;
    for (int axis = 0; axis < 3; ++axis) {
      d(axis) = x[static_cast<std::size_t>(axis)] - problems.position(j, static_cast<std::size_t>(axis))[trial];
    }
    const double e = d.norm() - problems.measured(j)[trial];
    const double weight = robust ? solvers::PaperWeights(options, problems.points(), 3)(0, 1.0, e) : 1.0;
    normal += weight * d.normalized() * d.normalized().transpose();
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(normal).eigenvalues();
}

Point start_of(const core::ProblemBatch& problems, std::size_t t) {
  return {problems.start(0)[t], problems.start(1)[t], problems.start(2)[t]};
}

}  // namespace

Agreement compare_with_ceres(const char* solver, std::size_t trials, std::size_t points, double sigma_m) {
  constexpr double basin_m = 0.01;
  constexpr double max_condition = 1e4;
  const bool robust = std::string_view(solver) == "rrr";
  const auto loss = robust ? solvers::ReferenceLoss::HuberTheta : solvers::ReferenceLoss::WeightedSquares;
  const core::ProblemBatch problems = scenes(trials, points, sigma_m);
  solvers::SolverOptions options;
  options.k = k_index("fixed");
  options.step_tolerance_m = 1e-10;
  options.max_iterations = 10'000;
  const auto s = solve(solver, problems, options);

  Agreement a;
  a.trials = trials;
  for (std::size_t t = 0; t < trials; ++t) {
    if (status(s, t) != core::Status::Converged) continue;
    ++a.converged;
    const auto minimizer = solvers::minimize(problems, t, start_of(problems, t), {loss, theta_m});
    if (!minimizer.converged) continue;
    ++a.reference;
    const double gap = distance(estimate(s, t), minimizer.estimate);
    if (gap > basin_m) continue;
    ++a.same_basin;
    const Eigen::Vector3d lambda = eigenvalues(problems, t, minimizer.estimate, robust);
    if (lambda(2) > max_condition * lambda(0)) continue;
    ++a.conditioned;
    const auto g = solvers::gradient(problems, t, estimate(s, t), {loss, theta_m});
    const double bound = solvers::gradient_rounding_bound(problems, t, estimate(s, t), {loss, theta_m}) +
                         lambda(2) * largest_gap_allowed_m;
    a.arrived += gap <= largest_gap_allowed_m ? 1 : 0;
    a.largest_gap_m = std::max(a.largest_gap_m, gap);
    a.largest_gradient = std::max(a.largest_gradient, std::hypot(g[0], g[1], g[2]) / bound);
  }
  return a;
}

std::vector<StepAtMinimizer> steps_at_minimizer(const char* solver, std::size_t trials, std::size_t points,
                                                double sigma_m) {
  const bool robust = std::string_view(solver) == "rrr";
  const auto loss = robust ? solvers::ReferenceLoss::HuberTheta : solvers::ReferenceLoss::WeightedSquares;
  core::ProblemBatch problems = scenes(trials, points, sigma_m);
  std::vector<solvers::Minimizer> minimizers;
  for (std::size_t t = 0; t < trials; ++t) {
    minimizers.push_back(solvers::minimize(problems, t, start_of(problems, t), {loss, theta_m}));
    for (std::size_t axis = 0; axis < 3; ++axis) problems.start(axis)[t] = minimizers[t].estimate[axis];
  }
  const std::vector<double> origin(trials, 0.0);
  core::Oracle oracle;
  for (auto& axis : oracle.truth) axis = origin;
  oracle.range_sigma_m = sigma_m;

  std::vector<StepAtMinimizer> results;
  for (const auto& estimator : solvers::k_estimator_registry()) {
    StepAtMinimizer result;
    result.k = estimator.name;
    result.learns = estimator.needs_ols_step;
    result.trials = trials;
    auto options = steps(1);
    options.k = *solvers::find_k_estimator(estimator.name);
    options.k_fixed = 0.1;
    options.k_formula = solvers::compile_k("geomean(sigma2 / alpha^2)");
    const auto s = solve(solver, problems, options, &oracle);
    for (std::size_t t = 0; t < trials; ++t) {
      if (!minimizers[t].converged) continue;
      ++result.reference;
      if (status(s, t) == core::Status::Singular) {
        ++result.singular;
        continue;
      }
      const double step = distance(estimate(s, t), minimizers[t].estimate);
      const double bound = solvers::gradient_rounding_bound(problems, t, minimizers[t].estimate, {loss, theta_m}) /
                           eigenvalues(problems, t, minimizers[t].estimate, robust)(0);
      result.largest_step_m = std::max(result.largest_step_m, step);
      result.largest_ratio = std::max(result.largest_ratio, step / bound);
    }
    results.push_back(result);
  }
  return results;
}

}  // namespace ridgeloc::tests
