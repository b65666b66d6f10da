#include "solvers/reference/reference_objective.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solvers/reference/reference_trial.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::solvers {

namespace {

// What irls promises (docs/methods.md), stated once more: the reference does not ask the solver.
constexpr double normal_consistency = 1.4826;
constexpr double smallest_scale = 1e-9;
constexpr double floor_of_weights = 0.01;

double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

}  // namespace

std::optional<ReferenceObjective> reference_objective(std::string_view solver, const SolverOptions& options) {
  if (options.jacobian == Jacobian::Printed || options.residual == Residual::Quotient) return std::nullopt;
  ReferenceObjective objective;
  objective.score_power = options.score_power;
  objective.v_mode = solver == "gn_prior" ? VMode::Prior : options.v_mode;
  objective.z_mode = options.z_mode;
  objective.sigma_prior_m = options.sigma_prior_m;
  const bool ridge = solver == "rr" || solver == "rrr";
  if (ridge && options.ridge_anchor == RidgeAnchor::Prior) return std::nullopt;
  if (solver == "ols" || solver == "gn_prior" || solver == "lm" || solver == "dogleg" || solver == "rr") {
    return objective;
  }
  if (solver == "rrr") {
    if (options.normalize_weights == NormalizeWeights::On && options.v_mode == VMode::Prior) return std::nullopt;
    objective.loss = ReferenceLoss::HuberTheta;
    objective.theta_m = options.theta_m;
    objective.robust_from = options.irls_min_n;
    objective.binding = options.irls_residual == IrlsResidual::Current;
    return objective;
  }
  if (solver == "irls" && options.weight < weight_registry().size()) {
    const auto shape = find_loss_shape(weight_registry()[options.weight].name);
    if (!shape) return std::nullopt;
    objective.loss = ReferenceLoss::Reweighted;
    objective.robust = {*shape, options.tuning > 0.0 ? options.tuning : standard_tuning(*shape), 1.0, floor_of_weights,
                        0.0};
    objective.fixed_scale_m = options.scale == Scale::Fixed ? options.scale_m : 0.0;
    return objective;
  }
  return std::nullopt;
}

ReferenceObjective at_estimate(const ReferenceObjective& objective, const core::ProblemBatch& problems,
                               std::size_t trial, const ReferencePlace& estimate) {
  if (objective.loss != ReferenceLoss::Reweighted) return objective;
  ReferenceObjective frozen = objective;
  const ReferenceTrial view(problems, trial, objective);
  std::vector<double> sizes = view.residuals(view.unknowns_of(estimate));
  for (double& size : sizes) size = std::abs(size);
  const double scale = objective.fixed_scale_m > 0.0 ? objective.fixed_scale_m : normal_consistency * median(sizes);
  frozen.robust.scale_m = std::max(scale, smallest_scale);
  frozen.robust.lift = 0.0;
  double sum = 0.0;
  for (const double size : sizes) sum += frozen.robust.weight(size);
  const auto needed = static_cast<double>(view.unknowns());
  const auto all = static_cast<double>(sizes.size());
  // With fewer observations than unknowns no weights are enough.
  if (sum < needed) frozen.robust.lift = all > needed ? (needed - sum) / (all - sum) : 1.0;
  return frozen;
}

}  // namespace ridgeloc::solvers
