#pragma once

#include <tuple>
#include <type_traits>

#include "solvers/methods/closed_form.hpp"
#include "solvers/methods/declaration.hpp"
#include "solvers/methods/dogleg.hpp"
#include "solvers/methods/irls.hpp"
#include "solvers/methods/lm.hpp"
#include "solvers/methods/ols.hpp"
#include "solvers/methods/ridge.hpp"

namespace ridgeloc::solvers {

/// The solvers, in the order in which `list` shows them. A new one is a file with its class and a line here.
using Methods = std::tuple<Ols, LevenbergMarquardt, Dogleg, RidgeRegression, RobustRidgeRegression, Irls,
                           PriorGaussNewton, Linear, Bancroft>;

static_assert(are_declared(std::type_identity<Methods>{}));

}  // namespace ridgeloc::solvers
