#pragma once

#include <cstddef>

#include "core/real.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// Weights of a method at one iterate: a function object `weights(j, score, residual)`; `largest()` is what an
/// observation of score 1 with a small residual weighs.

/// s or s^2.
template <class Score>
Score score_weight(const Score& score, bool squared) {
  return squared ? score * score : score;
}

/// Least-squares weights w_i = s_i^2 (RRR paper, eq. 7), or s_i.
struct ScoreWeights {
  bool squared;

  [[gnu::always_inline]] explicit ScoreWeights(const SolverOptions& options)
      : squared(options.score_power != ScorePower::One) {}

  template <class Score, class Real>
  [[gnu::always_inline]] Score operator()(std::size_t, const Score& score, const Real&) const {
    return score_weight(score, squared);
  }
  double largest() const { return 1.0; }
};

/// Robust weights w_i = s_i / max(theta, |e_i|) from `min_points` on, s_i below, where no residual can tell an outlier
/// (RRR paper, eq. 14, absolute value and index restored). It is Huber's weight up to the factor theta, so the fixed
/// point minimises sum s_i huber_theta(e_i) / theta.
struct PaperWeights {
  bool squared;
  bool robust;
  double theta_m;

  [[gnu::always_inline]] PaperWeights(const SolverOptions& options, std::size_t points, std::size_t unknowns)
      : squared(options.score_power == ScorePower::Two),
        robust(options.irls_min_n > 0 ? points >= static_cast<std::size_t>(options.irls_min_n) : points > unknowns),
        theta_m(options.theta_m) {}

  template <class Score, class Real>
  [[gnu::always_inline]] Real operator()(std::size_t, const Score& score, const Real& residual) const {
    const Score power = score_weight(score, squared);
    if (!robust) return power * Real(1.0);
    return power * core::reciprocal(core::max(Real(theta_m), core::abs(residual)));
  }

  /// Weight of an observation with a small residual.
  double largest() const { return robust ? 1.0 / theta_m : 1.0; }
};

}  // namespace ridgeloc::solvers
