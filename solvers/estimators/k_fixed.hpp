#pragma once

#include <string_view>

#include "solvers/estimators/k_context.hpp"

namespace ridgeloc::solvers {

/// The same constant k for every component, trial and iteration.
struct FixedK : KDefaults {
  static constexpr std::string_view name = "fixed";
  static constexpr std::string_view summary = "a constant, given by k_fixed";
  static constexpr bool needs_ols_step = false;

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return every<P>(Real(c.options.k_fixed));
  }
};

}  // namespace ridgeloc::solvers
