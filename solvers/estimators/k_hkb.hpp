#pragma once

#include <string_view>

#include "solvers/estimators/k_context.hpp"

namespace ridgeloc::solvers {

/// k = p sigma2 / (b'b), b = dx_ls: the harmonic mean of sigma2 / alpha_i^2 (Hoerl, Kennard and Baldwin 1975).
struct HoerlKennardBaldwin : KDefaults {
  static constexpr std::string_view name = "hkb";
  static constexpr std::string_view summary = "p sigma2 / (b'b), b = dx_ls: Hoerl, Kennard and Baldwin";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return every<P>(Real(static_cast<double>(P)) * c.sigma2 * core::reciprocal(sum(squared_alpha(c))));
  }
};

}  // namespace ridgeloc::solvers
