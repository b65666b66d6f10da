#pragma once

#include <array>
#include <cstddef>

#include "core/problem.hpp"

namespace ridgeloc::solvers {

/// Which objective the reference minimises. Residuals e_i = |p_i - x| - m_i (m), scores s_i, n points, p = 3
/// unknowns.
enum class ReferenceLoss {
  /// 1/2 sum (s_i e_i)^2, so W = diag(s_i^2): the objective of ols, lm and rr.
  WeightedSquares,
  /// sum (s_i / theta) h(e_i) with Huber's h(e) = e^2 / 2 up to theta and theta (|e| - theta / 2) beyond, so
  /// w_i = s_i / max(theta, |e_i|): the objective of rrr for n > p. For n <= p 1/2 sum s_i e_i^2, so w_i =
  /// s_i.
  HuberTheta,
};

/// Where the reference ended.
struct Minimizer {
  std::array<double, core::position_parameters> estimate;  ///< position (m)
  /// Whether the estimate is a strict local minimum to rounding: the gradient is below
  /// `gradient_rounding_bound` and the Hessian of the objective is positive definite.
  bool converged = false;
  double cost = 0.0;           ///< the objective at the estimate
  double gradient_norm = 0.0;  ///< |J'We| at the estimate
  int iterations = 0;          ///< trust-region iterations of Ceres, rejected ones included
};

/// Minimises the objective of one trial with Ceres, from `start`, and refines the answer by Newton's method.
///
/// An implementation independent of the solvers under test: Ceres' Levenberg-Marquardt method with
/// derivatives by automatic differentiation. It accepts steps by decrease of the cost, which fixes x only to
/// about the square root of the rounding error; Newton steps on J'We = 0, taken while the gradient norm
/// falls, reach rounding itself.
///
/// `theta_m` (m) is used by HuberTheta alone and must be positive there. Non-finite or otherwise unusable
/// input (negative scores, a start on one of the points) gives converged = false. Prints nothing, throws
/// nothing but std::bad_alloc, and may run in several threads at once.
Minimizer minimize(const core::ProblemBatch& problems, std::size_t trial,
                   const std::array<double, core::position_parameters>& start, ReferenceLoss loss, double theta_m);

/// J'We of one trial at `estimate` as Ceres evaluates it; NaN where it is not defined.
std::array<double, core::position_parameters> gradient(const core::ProblemBatch& problems, std::size_t trial,
                                                       const std::array<double, core::position_parameters>& estimate,
                                                       ReferenceLoss loss, double theta_m);

/// Largest |J'We| that rounding alone can leave at the representable position nearest to a stationary point:
/// 4 eps sum w_i (r_i + m_i + |x|), r_i = |p_i - x|.
///
/// A computed r_i is off by at most 3 eps r_i, the difference r_i - m_i by another eps / 2 of its operands,
/// and the rounding of x itself moves r_i by eps |x| / 2; the direction and the sum add terms in |e_i| <= r_i
/// + m_i that the factor 4 has room for. NaN where J'We is not defined.
double gradient_rounding_bound(const core::ProblemBatch& problems, std::size_t trial,
                               const std::array<double, core::position_parameters>& estimate, ReferenceLoss loss,
                               double theta_m);

}  // namespace ridgeloc::solvers
