#pragma once

#include <string_view>

#include "solvers/estimators/k_context.hpp"

namespace ridgeloc::solvers {

/// k = p sigma2 / sum(l_i alpha_i^2) = p sigma2 / (b'J'WJ b), b = dx_ls, l_i the eigenvalues of J'WJ: needs none of
/// them (Lawless and Wang 1976). The sum is floored as if b were as short as 1e-9 m.
struct LawlessWang : KDefaults {
  static constexpr std::string_view name = "lawless_wang";
  static constexpr std::string_view summary = "p sigma2 / sum(l_i alpha_i^2): Lawless and Wang";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    const Real floor(k_length_floor_m * k_length_floor_m);
    const Real fitted = core::dot(c.ols_step, core::multiply(c.least_squares.matrix, c.ols_step));
    return every<P>(Real(static_cast<double>(P)) * c.sigma2 * core::reciprocal(core::max(fitted, floor)));
  }
};

}  // namespace ridgeloc::solvers
