#pragma once

#include <string_view>

#include "solvers/estimators/k_context.hpp"

namespace ridgeloc::solvers {

/// k = median of sigma2 / alpha_i^2, the mean of the middle two for an even number (Kibria 2003).
struct KibriaMed : KDefaults {
  static constexpr std::string_view name = "kibria_med";
  static constexpr std::string_view summary = "median of sigma2 / alpha_i^2: Kibria";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    const core::Vector<Real, P> squared = squared_alpha(c);
    return every<P>(median_of(core::make_vector<P>([&](auto i) { return c.sigma2 * core::reciprocal(squared[i]); })));
  }
};

}  // namespace ridgeloc::solvers
