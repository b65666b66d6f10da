#pragma once

#include <string_view>

#include "solvers/estimators/k_context.hpp"

namespace ridgeloc::solvers {

/// Generalized ridge, k_i = sigma2 / alpha_i^2: what minimises the mean square error where alpha is in canonical
/// coordinates and known (Hoerl and Kennard 1970).
struct HoerlKennard : KDefaults {
  static constexpr std::string_view name = "hk";
  static constexpr std::string_view summary = "sigma2 / alpha_i^2: Hoerl and Kennard's generalized ridge";
  static constexpr bool is_scalar = false;

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    const core::Vector<Real, P> squared = squared_alpha(c);
    return core::make_vector<P>([&](auto i) { return c.sigma2 * core::reciprocal(squared[i]); });
  }
};

}  // namespace ridgeloc::solvers
