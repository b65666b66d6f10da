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

/// One estimator of K, with what all of them share: the choice of coordinates and the way back.
template <class KEstimator, class Real, std::size_t P>
void estimate_k(KContext<Real, P>& c, RidgeMatrix<Real, P>& out) {
  const auto diagonal = [&out](const core::Vector<Real, P>& k) {
    out = {};
    core::unroll<P>([&](auto i) { out(i, i) = k[i]; });
  };
  c.alpha = c.ols_step;
  const bool canonical = KEstimator::needs_eigenvalues ||
                         (KEstimator::needs_ols_step && c.options.ridge_coordinates == RidgeCoordinates::Canonical);
  if (!canonical) return diagonal(KEstimator{}(c));

  const auto eigen = core::symmetric_eigen(c.least_squares.matrix);
  c.eigenvalues = eigen.values;
  c.alpha = core::make_vector<P>([&](auto i) { return core::dot(eigen.vectors[i], c.ols_step); });
  const core::Vector<Real, P> k = KEstimator{}(c);
  if constexpr (KEstimator::is_scalar) {
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

/// What the estimator of an index asks for.
struct KTraits {
  bool needs_ols_step;
  bool needs_squares;
};
template <class KEstimator>
constexpr KTraits traits_of() {
  return {KEstimator::needs_ols_step, KEstimator::needs_squares};
}
template <class Real>
const KTraits& k_traits(std::size_t index) {
  static constexpr auto traits = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{traits_of<std::tuple_element_t<I, KEstimators>>()...};
  }
  (std::make_index_sequence<std::tuple_size_v<KEstimators>>{});
  return traits[index];
}

}  // namespace ridgeloc::solvers
