#pragma once

#include <string_view>

#include "solvers/estimators/k_context.hpp"
#include "solvers/estimators/true_k.hpp"

namespace ridgeloc::solvers {

/// The paper's estimator: one scalar for all components, the geometric mean of sigma2 / alpha_i^2,
/// k = sigma2 / (prod_i alpha_i^2)^(1/p) (RRR paper, eq. 12, with exponent p where the print says n; Kibria 2003).
struct KibriaGm : KDefaults {
  static constexpr std::string_view name = "kibria_gm";
  static constexpr std::string_view summary = "geometric mean of sigma2 / alpha_i^2: the paper's estimate";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return every<P>(c.sigma2 * inverse_geometric_mean(squared_alpha(c)));
  }
};

}  // namespace ridgeloc::solvers
