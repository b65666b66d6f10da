#pragma once

#include "core/elementary.hpp"
#include "core/matrix.hpp"
#include "solvers/estimators/k_context.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// The product of p positive numbers to the power -1/p: the inverse of their geometric mean. The exponents of three
/// factors may add up to +-1022.
template <class Real, std::size_t P>
Real inverse_geometric_mean(const core::Vector<Real, P>& factors) {
  if constexpr (P == 3) {
    return core::inverse_cube_root(factors[0] * factors[1] * factors[2]);
  } else if constexpr (P == 2) {
    return core::root_and_inverse(factors[0] * factors[1]).inverse;
  } else {
    static_assert(P == 4);
    const Real squared = core::sqrt(factors[0] * factors[1]) * core::sqrt(factors[2] * factors[3]);
    return core::root_and_inverse(squared).inverse;
  }
}

/// The true ridge parameter at iterate u: k'_i = sigma^2 / (u - u_true)_i^2 (RRR paper, eq. 11), or for `Gm` its
/// geometric mean in every component. Errors below `k_length_floor_m` count as that long.
template <class Real, std::size_t P>
core::Vector<Real, P> true_k(KTrue reading, const core::Vector<Real, P>& u, const TrialOracle<Real, P>& oracle) {
  const core::Vector<Real, P> squared = core::make_vector<P>([&](auto i) {
    const Real error = core::max(core::abs(u[i] - oracle.truth[i]), Real(k_length_floor_m));
    return error * error;
  });
  if (reading == KTrue::Elem) {
    return core::make_vector<P>([&](auto i) { return oracle.range_variance * core::reciprocal(squared[i]); });
  }
  return every<P>(oracle.range_variance * inverse_geometric_mean(squared));
}

/// Similarity of two ridge parameters, eta = 1 / (1 + sqrt(sum_i (K_i - K'_i)^2)) in (0, 1] (RRR paper, eq. 15, with
/// the square that the print lacks), or the printed reading `Absolute`.
template <class Real, std::size_t P>
Real similarity(Eta eta, const core::Vector<Real, P>& k, const core::Vector<Real, P>& k_true) {
  const core::Vector<Real, P> d = core::subtract(k, k_true);
  const Real squared = eta == Eta::Squared ? core::dot(d, d) : core::abs(sum(d));
  return core::reciprocal(Real(1.0) + core::sqrt(squared));
}

}  // namespace ridgeloc::solvers
