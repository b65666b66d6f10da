#pragma once

#include <string_view>

#include "solvers/k_context.hpp"

namespace ridgeloc::solvers {

/// The same constant k for every component, trial and iteration.
struct FixedK {
  static constexpr std::string_view name = "fixed";
  static constexpr std::string_view summary = "a constant, given by k_fixed";
  static constexpr bool needs_ols_step = false;
  static constexpr bool needs_oracle = false;

  template <class Real>
  core::Vector3<Real> operator()(const KContext<Real>& c) const {
    const Real k(c.options.k_fixed);
    return {k, k, k};
  }
};

}  // namespace ridgeloc::solvers
