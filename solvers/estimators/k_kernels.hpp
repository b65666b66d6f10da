#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/symmetric_eigen.hpp"
#include "solvers/estimators/k_context.hpp"
#include "solvers/estimators/k_registry.hpp"

namespace ridgeloc::solvers {

/// The ridge parameter as a matrix: diagonal in the coordinates of the unknowns or along the eigenvectors of J'WJ.
template <class Real, std::size_t P>
using RidgeMatrix = core::Symmetric<Real, P>;

/// Estimates K from a context, whose alpha and eigenvalues it fills.
template <class Real, std::size_t P>
using KKernel = void (*)(KContext<Real, P>&, RidgeMatrix<Real, P>&);

/// What an estimator asks for: its class knows, or for a formula the options.
template <class KEstimator, class Real>
[[gnu::always_inline]] inline KTraits traits_of(const SolverOptions& options) {
  if constexpr (requires { KEstimator::template traits<Real>(options); }) {
    return KEstimator::template traits<Real>(options);
  } else {
    return {KEstimator::needs_ols_step, KEstimator::needs_squares, KEstimator::needs_eigenvalues,
            KEstimator::is_scalar};
  }
}

/// One estimator of K, with what all of them share: the choice of coordinates and the way back.
template <class KEstimator, class Real, std::size_t P>
void estimate_k(KContext<Real, P>& c, RidgeMatrix<Real, P>& out) {
  const KTraits traits = traits_of<KEstimator, Real>(c.options);
  const auto diagonal = [&out](const core::Vector<Real, P>& k) {
    out = {};
    core::unroll<P>([&](auto i) { out(i, i) = k[i]; });
  };
  c.alpha = c.ols_step;
  const bool canonical =
      traits.needs_eigenvalues || (traits.needs_ols_step && c.options.ridge_coordinates == RidgeCoordinates::Canonical);
  if (!canonical) return diagonal(KEstimator{}(c));

  const auto eigen = core::symmetric_eigen(c.least_squares.matrix);
  c.eigenvalues = eigen.values;
  c.alpha = core::make_vector<P>([&](auto i) { return core::dot(eigen.vectors[i], c.ols_step); });
  core::Vector<Real, P> k;
  if constexpr (requires { KEstimator{}(c, eigen); }) {
    k = KEstimator{}(c, eigen);
  } else {
    k = KEstimator{}(c);
  }
  if (traits.is_scalar) {
    diagonal(k);
  } else {
    core::unroll<P>([&](auto i) {
      core::unroll<P - i>([&](auto m) {
        constexpr std::size_t j = i + m;
        Real sum(0.0);
        core::unroll<P>([&](auto e) { sum = core::mul_add(k[e] * eigen.vectors[e][i], eigen.vectors[e][j], sum); });
        out(i, j) = sum;
      });
    });
  }
}

/// Whether the options ask for the paper's own estimator as it stands there. That one is inlined.
inline bool uses_paper_k(const SolverOptions& options) {
  static_assert(std::is_same_v<std::tuple_element_t<0, KEstimators>, KibriaGm>);
  return options.k == 0 && options.ridge_coordinates == RidgeCoordinates::Raw;
}

/// The estimator of an index. Called through a pointer, which costs little beside what is called: inlined into every
/// kernel, twenty estimators would make each of them twenty times as large.
template <class Real, std::size_t P>
KKernel<Real, P> k_kernel(std::size_t index) {
  static constexpr auto kernels = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<KKernel<Real, P>, sizeof...(I)>{estimate_k<std::tuple_element_t<I, KEstimators>, Real, P>...};
  }
  (std::make_index_sequence<std::tuple_size_v<KEstimators>>{});
  return kernels[index];
}

/// What the estimator that the options name asks for.
template <class Real>
KTraits k_traits(const SolverOptions& options) {
  using Traits = KTraits (*)(const SolverOptions&);
  static constexpr auto traits = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array<Traits, sizeof...(I)>{traits_of<std::tuple_element_t<I, KEstimators>, Real>...};
  }
  (std::make_index_sequence<std::tuple_size_v<KEstimators>>{});
  return traits[options.k](options);
}

}  // namespace ridgeloc::solvers
