#pragma once

#include <string_view>

#include "solvers/estimators/k_context.hpp"

namespace ridgeloc::solvers {

/// k = (p - 2) sigma2 / (b'b), b = dx_ls, for p > 2 unknowns; no ridge for two (Thisted 1976).
struct Thisted : KDefaults {
  static constexpr std::string_view name = "thisted";
  static constexpr std::string_view summary = "(p - 2) sigma2 / (b'b), b = dx_ls, 0 for p = 2: Thisted";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return every<P>(Real(static_cast<double>(P) - 2.0) * c.sigma2 * core::reciprocal(sum(squared_alpha(c))));
  }
};

}  // namespace ridgeloc::solvers
