#include "solvers/reference/reference_objective.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "solvers/reference/reference_trial.hpp"

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

/// The loss of a robust weight, whose scale `at_estimate` fills.
std::optional<RobustLoss> robust_loss(const SolverOptions& options) {
  if (options.weight >= weight_registry().size()) return std::nullopt;
  const auto shape = find_loss_shape(weight_registry()[options.weight].name);
  if (!shape) return std::nullopt;
  const double tuning = options.tuning > 0.0 ? options.tuning : standard_tuning(*shape);
  return RobustLoss{*shape, tuning, 1.0, floor_of_weights, 0.0};
}

}  // namespace

std::optional<ReferenceObjective> reference_objective(const Objective& said, const SolverOptions& options) {
  if (options.jacobian == Jacobian::Printed || options.residual == Residual::Quotient) return std::nullopt;
  if (!said.loss()) return std::nullopt;
  ReferenceObjective objective;
  objective.loss = *said.loss();
  objective.binding = said.is_binding();
  objective.score_power = options.score_power;
  objective.v_mode = options.v_mode;
  objective.z_mode = options.z_mode;
  objective.sigma_prior_m = options.sigma_prior_m;
  switch (objective.loss) {
    case ReferenceLoss::WeightedSquares:
      break;
    case ReferenceLoss::HuberTheta:
      objective.theta_m = options.theta_m;
      objective.robust_from = options.irls_min_n;
      break;
    case ReferenceLoss::Reweighted:
      const auto robust = robust_loss(options);
      if (!robust) return std::nullopt;
      objective.robust = *robust;
      objective.fixed_scale_m = options.scale == Scale::Fixed ? options.scale_m : 0.0;
      break;
  }
  return objective;
}

std::optional<ReferenceObjective> reference_objective(const SolverEntry& solver, const SolverOptions& options) {
  SolverOptions own = options;
  solver.adjust(own);
  return reference_objective(solver.objective(own), own);
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
