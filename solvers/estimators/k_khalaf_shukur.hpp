#pragma once

#include <string_view>

#include "solvers/estimators/k_context.hpp"

namespace ridgeloc::solvers {

/// k = l_max sigma2 / ((n - p) sigma2 + l_max alpha_max^2), l_max the largest eigenvalue of J'WJ and alpha_max^2 the
/// largest squared canonical component (Khalaf and Shukur 2005; no intercept here, so n - p degrees of freedom).
struct KhalafShukur : KDefaults {
  static constexpr std::string_view name = "khalaf_shukur";
  static constexpr std::string_view summary = "l_max sigma2 / ((n - p) sigma2 + l_max alpha_max^2): Khalaf and Shukur";
  static constexpr bool needs_eigenvalues = true;

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    const Real l = largest(c.eigenvalues);
    const Real freedom(static_cast<double>(c.observations) - static_cast<double>(P));
    return every<P>(l * c.sigma2 * core::reciprocal(core::mul_add(freedom, c.sigma2, l * largest(squared_alpha(c)))));
  }
};

}  // namespace ridgeloc::solvers
