#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <utility>

#include "solvers/k_fixed.hpp"
#include "solvers/k_kibria_gm.hpp"
#include "solvers/k_oracle.hpp"

namespace ridgeloc::solvers {

/// The estimators of the ridge parameter. A new one is a file with its class and a line here.
using KEstimators = std::tuple<KibriaGm, FixedK, OracleElem, OracleGm>;

/// Calls f with the estimator of that index. The index is the same for all lanes, so this is an ordinary branch.
template <class F>
void with_k_estimator(std::size_t index, F&& f) {
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    (void)((I == index && (f(std::get<I>(KEstimators{})), true)) || ...);
  }
  (std::make_index_sequence<std::tuple_size_v<KEstimators>>{});
}

}  // namespace ridgeloc::solvers
