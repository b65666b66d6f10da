#pragma once

#include "core/elementary.hpp"
#include "core/matrix3.hpp"
#include "solvers/k_context.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// The true ridge parameter at iterate x: k'_i = sigma^2 / (x - x_true)_i^2 (RRR paper, eq. 11), or for `Gm` its
/// geometric mean in every component. Errors below `k_length_floor_m` count as that long.
template <class Real>
core::Vector3<Real> true_k(KTrue reading, const core::Vector3<Real>& x, const TrialOracle<Real>& oracle) {
  core::Vector3<Real> squared;
  for (std::size_t i = 0; i < 3; ++i) {
    const Real error = core::max(core::abs(x[i] - oracle.truth[i]), Real(k_length_floor_m));
    squared[i] = error * error;
  }
  if (reading == KTrue::Elem) {
    return {oracle.range_variance * core::reciprocal(squared[0]), oracle.range_variance * core::reciprocal(squared[1]),
            oracle.range_variance * core::reciprocal(squared[2])};
  }
  const Real k = oracle.range_variance * core::inverse_cube_root(squared[0] * squared[1] * squared[2]);
  return {k, k, k};
}

/// Similarity of two ridge parameters, eta = 1 / (1 + sqrt(sum_i (K_i - K'_i)^2)) in (0, 1] (RRR paper, eq. 15, with
/// the square that the print lacks), or the printed reading `Absolute`.
template <class Real>
Real similarity(Eta eta, const core::Vector3<Real>& k, const core::Vector3<Real>& k_true) {
  const core::Vector3<Real> d = core::subtract(k, k_true);
  const Real squared = eta == Eta::Squared ? core::dot(d, d) : core::abs(d[0] + d[1] + d[2]);
  return core::reciprocal(Real(1.0) + core::sqrt(squared));
}

}  // namespace ridgeloc::solvers
