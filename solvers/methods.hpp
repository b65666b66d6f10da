#pragma once

#include <tuple>

#include "solvers/closed_form.hpp"
#include "solvers/dogleg.hpp"
#include "solvers/irls.hpp"
#include "solvers/lm.hpp"
#include "solvers/ols.hpp"
#include "solvers/ridge.hpp"

namespace ridgeloc::solvers {

/// The solvers, in the order in which `list` shows them. A new one is a file with its class and a line here.
using Methods = std::tuple<Ols, LevenbergMarquardt, Dogleg, RidgeRegression, RobustRidgeRegression, Irls,
                           PriorGaussNewton, Linear, Bancroft>;

}  // namespace ridgeloc::solvers
