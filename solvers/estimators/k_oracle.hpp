#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/random.hpp"
#include "solvers/estimators/k_context.hpp"
#include "solvers/estimators/true_k.hpp"

namespace ridgeloc::solvers {

/// A direction uniform on the unit sphere of P dimensions.
template <class Real, std::size_t P>
core::Vector<Real, P> direction(const core::Stream& stream, const core::Words<Real>& trial,
                                const core::Words<Real>& draw) {
  const auto uniform = core::uniform_pair<Real>(stream.block(trial, draw));
  if constexpr (P == 3) {
    return core::unit_vector(uniform);
  } else if constexpr (P == 2) {
    const auto angle = core::sin_cos_turns(uniform[1]);
    return {angle.cos, angle.sin};
  } else {
    // Two independent normal pairs; their draws are far beyond any iteration's.
    static_assert(P == 4);
    const auto first = core::normal_pair(uniform);
    const auto second = core::normal_pair(
        core::uniform_pair<Real>(stream.block(trial, draw + core::Words<Real>(std::uint64_t{1} << 40))));
    const core::Vector<Real, P> normal = {first[0], first[1], second[0], second[1]};
    return core::scale(core::root_and_inverse(core::dot(normal, normal)).inverse, normal);
  }
}

/// A K of given similarity eta0 to the true one: K~ = K' + d u with |u| = 1 and d = 1/eta0 - 1, so that
/// 1 / (1 + |K~ - K'|) = eta0. The direction u depends on the trial and the iteration alone: all methods share it.
template <class Real, std::size_t P>
core::Vector<Real, P> perturbed(const core::Vector<Real, P>& k, const KContext<Real, P>& c) {
  const double distance = 1.0 / c.options.similarity - 1.0;
  if (distance == 0.0) return k;
  const Real draw = c.options.k_error_draw == KErrorDraw::PerIteration ? c.iteration : Real(0.0);
  const core::Vector<Real, P> u = direction<Real, P>(c.oracle->k_error, c.oracle->trial, core::to_words(draw));
  return core::make_vector<P>([&](auto i) {
    return core::mul_add(Real(distance), c.options.k_error == KError::Positive ? core::abs(u[i]) : u[i], k[i]);
  });
}

/// The true K' by component, k'_i = sigma^2 / (x_k - x_true)_i^2, brought to a given similarity. Simulation only.
struct OracleElem : KDefaults {
  static constexpr std::string_view name = "oracle_elem";
  static constexpr std::string_view summary = "true K by component, perturbed to the given similarity";
  static constexpr bool needs_ols_step = false;
  static constexpr bool needs_oracle = true;
  static constexpr bool is_scalar = false;

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return perturbed(true_k(KTrue::Elem, c.u, *c.oracle), c);
  }
};

/// The geometric mean of the true K', brought to a given similarity. Simulation only.
struct OracleGm : KDefaults {
  static constexpr std::string_view name = "oracle_gm";
  static constexpr std::string_view summary = "geometric mean of the true K, perturbed to the given similarity";
  static constexpr bool needs_ols_step = false;
  static constexpr bool needs_oracle = true;
  static constexpr bool is_scalar = false;

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return perturbed(true_k(KTrue::Gm, c.u, *c.oracle), c);
  }
};

}  // namespace ridgeloc::solvers
