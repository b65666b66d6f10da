#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>

#include "core/problem.hpp"
#include "solvers/objective.hpp"
#include "solvers/options.hpp"
#include "solvers/reference/reference_loss.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::solvers {

/// An objective with all that its name leaves open.
struct ReferenceObjective {
  ReferenceLoss loss = ReferenceLoss::WeightedSquares;
  double theta_m = 0.05;                         ///< HuberTheta
  ScorePower score_power = ScorePower::Printed;  ///< Printed: 2, and 1 in HuberTheta
  int robust_from = 0;                           ///< HuberTheta: smallest n with robust weights; 0: p + 1
  RobustLoss robust = {};                        ///< Reweighted; scale and lift as `at_estimate` fills them
  double fixed_scale_m = 0.0;                    ///< Reweighted: the scale; 0: 1.4826 median |e_i|
  VMode v_mode = VMode::Free;                    ///< pseudoranges
  ZMode z_mode = ZMode::Free;                    ///< Fixed: the height is the start's
  double sigma_prior_m = 0.1;                    ///< weight of the prior on v
  /// Whether a converged trial of the solver must be where the objective says. If not, the gap to the reference is
  /// worth knowing and proves nothing.
  bool binding = true;

  bool operator==(const ReferenceObjective&) const = default;
};

/// What the reference minimises for an objective with these options, if it can: with `jacobian = printed` and
/// `residual = quotient` nothing is stationary where any solver ends, and a robust weight may have a loss that the
/// reference does not know.
std::optional<ReferenceObjective> reference_objective(const Objective& objective, const SolverOptions& options);

/// The same for what the solver says that it minimises, with the options as it adjusts them.
std::optional<ReferenceObjective> reference_objective(const SolverEntry& solver, const SolverOptions& options);

/// Where a trial stands.
struct ReferencePlace {
  std::array<double, core::position_parameters> position{};  ///< m
  /// mm; NaN: the start's. Nothing with ranges.
  double image_distance_mm = std::numeric_limits<double>::quiet_NaN();

  ReferencePlace() = default;
  ReferencePlace(const std::array<double, core::position_parameters>& at) : position(at) {}
  ReferencePlace(const std::array<double, core::position_parameters>& at, double v)
      : position(at), image_distance_mm(v) {}
};

/// The objective with the scale and the lift that irls has at an estimate: 1.4826 median |e_i| (at least 1e-9 m) unless
/// the scale is fixed; lift = (p - c) / (n - c) where the weights, none below 0.01, have a sum c below p, otherwise 0.
/// Where irls rests, this objective is stationary. Other objectives are returned as they are.
ReferenceObjective at_estimate(const ReferenceObjective& objective, const core::ProblemBatch& problems,
                               std::size_t trial, const ReferencePlace& estimate);

}  // namespace ridgeloc::solvers
