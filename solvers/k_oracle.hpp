#pragma once

#include <string_view>

#include "core/random.hpp"
#include "solvers/k_context.hpp"
#include "solvers/true_k.hpp"

namespace ridgeloc::solvers {

/// A K of given similarity eta0 to the true one: K~ = K' + d u with |u| = 1 and d = 1/eta0 - 1, so that
/// 1 / (1 + |K~ - K'|) = eta0. The direction u depends on the trial and the iteration alone: all methods share it.
template <class Real>
core::Vector3<Real> perturbed(const core::Vector3<Real>& k, const KContext<Real>& c) {
  const double distance = 1.0 / c.options.similarity - 1.0;
  if (distance == 0.0) return k;
  const Real draw = c.options.k_error_draw == KErrorDraw::PerIteration ? c.iteration : Real(0.0);
  const auto block = c.oracle->k_error.block(c.oracle->trial, core::to_words(draw));
  core::Vector3<Real> u = core::unit_vector(core::uniform_pair<Real>(block));
  core::Vector3<Real> result;
  for (std::size_t i = 0; i < 3; ++i) {
    if (c.options.k_error == KError::Positive) u[i] = core::abs(u[i]);
    result[i] = core::mul_add(Real(distance), u[i], k[i]);
  }
  return result;
}

/// The true K' by component, k'_i = sigma^2 / (x_k - x_true)_i^2, brought to a given similarity. Simulation only.
struct OracleElem {
  static constexpr std::string_view name = "oracle_elem";
  static constexpr std::string_view summary = "true K by component, perturbed to the given similarity";
  static constexpr bool needs_ols_step = false;
  static constexpr bool needs_oracle = true;

  template <class Real>
  core::Vector3<Real> operator()(const KContext<Real>& c) const {
    return perturbed(true_k(KTrue::Elem, c.x, *c.oracle), c);
  }
};

/// The geometric mean of the true K', brought to a given similarity. Simulation only.
struct OracleGm {
  static constexpr std::string_view name = "oracle_gm";
  static constexpr std::string_view summary = "geometric mean of the true K, perturbed to the given similarity";
  static constexpr bool needs_ols_step = false;
  static constexpr bool needs_oracle = true;

  template <class Real>
  core::Vector3<Real> operator()(const KContext<Real>& c) const {
    return perturbed(true_k(KTrue::Gm, c.x, *c.oracle), c);
  }
};

}  // namespace ridgeloc::solvers
