#pragma once

#include <tuple>

#include "solvers/lm.hpp"
#include "solvers/ols.hpp"
#include "solvers/ridge.hpp"

namespace ridgeloc::solvers {

/// The iterative solvers, in the order in which `list` shows them. A new one is a file with its class and a line here.
using Methods = std::tuple<Ols, LazyLevenbergMarquardt, RidgeRegression, RobustRidgeRegression>;

}  // namespace ridgeloc::solvers
