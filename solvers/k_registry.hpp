#pragma once

#include <tuple>

#include "solvers/k_fixed.hpp"
#include "solvers/k_kibria_gm.hpp"
#include "solvers/k_oracle.hpp"

namespace ridgeloc::solvers {

/// The estimators of the ridge parameter. A new one is a file with its class and a line here.
using KEstimators = std::tuple<KibriaGm, FixedK, OracleElem, OracleGm>;

}  // namespace ridgeloc::solvers
