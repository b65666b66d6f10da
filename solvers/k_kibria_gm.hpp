#pragma once

#include <string_view>

#include "core/elementary.hpp"
#include "solvers/k_context.hpp"

namespace ridgeloc::solvers {

/// The paper's estimator: one scalar for all components, the geometric mean of sigma2 / dx_i^2,
/// k = sigma2 / (prod_i dx_ls,i^2)^(1/p), p = 3 (RRR paper, eq. 12, with exponent p where the print says n;
/// Kibria 2003).
struct KibriaGm {
  static constexpr std::string_view name = "kibria_gm";
  static constexpr std::string_view summary = "sigma2 / (prod dx_i^2)^(1/p): the paper's geometric-mean estimate";
  static constexpr bool needs_ols_step = true;
  static constexpr bool needs_oracle = false;

  template <class Real>
  core::Vector3<Real> operator()(const KContext<Real>& c) const {
    const Real floor(k_length_floor_m);
    const Real product = core::max(core::abs(c.ols_step[0]), floor) * core::max(core::abs(c.ols_step[1]), floor) *
                         core::max(core::abs(c.ols_step[2]), floor);
    const Real k = c.sigma2 * core::inverse_cube_root(product * product);
    return {k, k, k};
  }
};

}  // namespace ridgeloc::solvers
