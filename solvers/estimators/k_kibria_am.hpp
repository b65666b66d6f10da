#pragma once

#include <string_view>

#include "solvers/estimators/k_context.hpp"

namespace ridgeloc::solvers {

/// k = mean of sigma2 / alpha_i^2 (Kibria 2003).
struct KibriaAm : KDefaults {
  static constexpr std::string_view name = "kibria_am";
  static constexpr std::string_view summary = "arithmetic mean of sigma2 / alpha_i^2: Kibria";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    const core::Vector<Real, P> squared = squared_alpha(c);
    const auto inverse = core::make_vector<P>([&](auto i) { return core::reciprocal(squared[i]); });
    return every<P>(Real(1.0 / static_cast<double>(P)) * c.sigma2 * sum(inverse));
  }
};

}  // namespace ridgeloc::solvers
