#pragma once

#include <string_view>

#include "solvers/estimators/k_context.hpp"

namespace ridgeloc::solvers {

/// k = sigma2 / max alpha_i^2 (Hoerl and Kennard 1970).
struct HoerlKennardMax : KDefaults {
  static constexpr std::string_view name = "hk_max";
  static constexpr std::string_view summary = "sigma2 / max alpha_i^2: Hoerl and Kennard's single k";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return every<P>(c.sigma2 * core::reciprocal(largest(squared_alpha(c))));
  }
};

}  // namespace ridgeloc::solvers
