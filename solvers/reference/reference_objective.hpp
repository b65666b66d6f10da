#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>

#include "core/problem.hpp"
#include "solvers/options.hpp"
#include "solvers/reference/reference_loss.hpp"

namespace ridgeloc::solvers {

/// Which objective the reference minimises. Residuals e_i (m), scores s_i, n points, p unknowns.
enum class ReferenceLoss {
  /// 1/2 sum s_i^2 e_i^2, so W = diag(s_i^2): the objective of ols, gn_prior, lm, dogleg and rr.
  WeightedSquares,
  /// sum (s_i / theta) h(e_i) with Huber's h(e) = e^2 / 2 up to theta and theta (|e| - theta / 2) beyond, so
  /// w_i = s_i / max(theta, |e_i|): the objective of rrr for n > p. For n <= p 1/2 sum s_i e_i^2, so w_i = s_i.
  HuberTheta,
  /// 1/2 sum s_i^2 rho(e_i^2) with rho of the robust weight, at a scale and a lift that are given: the objective of
  /// irls.
  Reweighted,
};

/// The objective of a solver. What the method does on its way (damping, K, scaling of columns) is no part of it.
struct ReferenceObjective {
  ReferenceLoss loss = ReferenceLoss::WeightedSquares;
  double theta_m = 0.05;                         ///< HuberTheta
  ScorePower score_power = ScorePower::Printed;  ///< Printed: 2, and 1 in HuberTheta
  int robust_from = 0;                           ///< HuberTheta: smallest n with robust weights; 0: p + 1
  RobustLoss robust = {};                        ///< Reweighted; scale and lift as `at_estimate` fills them
  double fixed_scale_m = 0.0;                    ///< Reweighted: the scale; 0: 1.4826 median |e_i|
  VMode v_mode = VMode::Free;                    ///< pseudoranges
  ZMode z_mode = ZMode::Free;                    ///< pseudoranges
  double sigma_prior_m = 0.1;                    ///< weight of the prior on v
  /// Whether a converged trial of the solver must be where the objective says. If not, the gap to the reference is
  /// worth knowing and proves nothing.
  bool binding = true;

  bool operator==(const ReferenceObjective&) const = default;
};

/// The objective that a solver with these options minimises, if it does minimise one:
/// - linear and bancroft minimise something else, `jacobian = printed` and `residual = quotient` end where no objective
///   is stationary, `ridge_anchor = prior` is biased on purpose, and `normalize_weights` with a prior on v weighs the
///   two against each other anew at every iterate: none;
/// - rrr with `irls_residual = ols` has that of rrr, not binding, since its weights are made elsewhere.
std::optional<ReferenceObjective> reference_objective(std::string_view solver, const SolverOptions& options);

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
