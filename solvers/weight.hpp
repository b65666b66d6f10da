#pragma once

#include <cstddef>

#include "core/problem.hpp"
#include "core/real.hpp"

namespace ridgeloc::solvers {

/// Least-squares weight w_i = s_i^2 (RRR paper, eq. 7).
template <class Score>
Score score_weight(const Score& score) {
  return score * score;
}

/// Robust weight w_i = s_i / max(theta, |e_i|) for n > p, s_i otherwise, where no residual can tell an outlier
/// (RRR paper, eq. 14, absolute value and index restored). It is Huber's weight up to the factor theta, so its fixed
/// point minimises sum s_i huber_theta(e_i) / theta.
template <class Score, class Real>
Real robust_weight(const Score& score, const Real& residual, std::size_t points, double theta_m) {
  if (points <= core::position_parameters) return score * Real(1.0);
  return score * core::reciprocal(core::max(Real(theta_m), core::abs(residual)));
}

}  // namespace ridgeloc::solvers
