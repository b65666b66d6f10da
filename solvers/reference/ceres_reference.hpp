#pragma once

#include <array>
#include <cstddef>

#include "core/problem.hpp"
#include "solvers/reference/reference_objective.hpp"

namespace ridgeloc::solvers {

/// Where the reference ended.
struct Minimizer {
  std::array<double, core::position_parameters> estimate;  ///< position (m)
  double image_distance_mm = 0.0;                          ///< of pseudoranges
  /// Whether the estimate is a strict local minimum to rounding: the gradient is below `gradient_rounding_bound` and
  /// the Hessian of the objective is positive definite.
  bool converged = false;
  double cost = 0.0;           ///< the objective at the estimate
  double gradient_norm = 0.0;  ///< |J'We| at the estimate, see `gradient_rounding_bound`
  int iterations = 0;          ///< trust-region iterations of Ceres, rejected ones included

  ReferencePlace place() const { return {estimate, image_distance_mm}; }
};

/// Minimises the objective of one trial with Ceres, from `start`, and refines the answer by Newton's method.
///
/// An implementation independent of the solvers under test: Ceres' Levenberg-Marquardt method with derivatives by
/// automatic differentiation. It accepts steps by decrease of the cost, which fixes x only to about the square root of
/// the rounding error; Newton steps on J'We = 0, taken while the gradient norm falls, reach rounding itself.
///
/// Non-finite or otherwise unusable input (negative scores, a start on one of the points, a pseudorange with no length,
/// a theta that is not positive where it is used) gives converged = false. Prints nothing, throws nothing but
/// std::bad_alloc, and may run in several threads at once. What is known of a place (a fixed height or image distance)
/// is the start's of the batch, whatever `start` says.
Minimizer minimize(const core::ProblemBatch& problems, std::size_t trial, const ReferencePlace& start,
                   const ReferenceObjective& objective);

/// J'We of one trial at `estimate` as Ceres evaluates it, by x, y, z (m) and v (mm); zero by what is known, NaN where
/// it is not defined.
std::array<double, 4> gradient(const core::ProblemBatch& problems, std::size_t trial, const ReferencePlace& estimate,
                               const ReferenceObjective& objective);

/// Largest |J'We| that rounding alone can leave at the representable place nearest to a stationary point:
/// 4 eps sum w_i |J_i| (r_i + m_i + |x|), r_i = |p_i - x|.
///
/// A computed r_i is off by at most 3 eps r_i, the difference r_i - m_i by another eps / 2 of its operands, and the
/// rounding of x itself moves r_i by eps |x| / 2; the direction and the sum add terms in |e_i| <= r_i + m_i that the
/// factor 4 has room for. Pseudoranges m_i = sqrt(alpha v^2 + rho) count 2 alpha v^2 + |rho| over m_i too, times
/// 1 + |e_i| / m_i, for what cancels in the sum. The norm takes v as a length, in units of the root mean square of
/// dm/dv at the start. NaN where J'We is not defined.
double gradient_rounding_bound(const core::ProblemBatch& problems, std::size_t trial, const ReferencePlace& estimate,
                               const ReferenceObjective& objective);

/// The objective at a place, and the Gauss-Newton step (J'WJ)^-1 J'We from there, with J'We as Ceres evaluates it.
struct ReferenceStep {
  double cost;
  double step_m;  ///< length of its position part; NaN where J'WJ is too close to singular for any digit of it
  /// How much the step that a solver computes in another order may differ from that by rounding:
  /// |(J'WJ)^-1| times the rounding of J'We, and 100 eps c of the step, where c is the product of the ratios of the
  /// largest eigenvalue of J'WJ to each of them. That is the factor by which solving with determinants amplifies
  /// rounding; step_m is NaN for c > 1e12.
  double step_error_m;
  double cost_error;  ///< rounding of the cost: half the sum of w (4 eps (r + m + |x|))^2
};
ReferenceStep undamped_step(const core::ProblemBatch& problems, std::size_t trial, const ReferencePlace& estimate,
                            const ReferenceObjective& objective);

}  // namespace ridgeloc::solvers
