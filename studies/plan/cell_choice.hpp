#pragma once

#include <string_view>

#include "studies/plan/plan.hpp"

namespace ridgeloc::studies {

/// The cell that a text names: its number, or values of swept settings that leave one cell, "points=5,depth_m=[1,10]".
/// An empty text names the only cell of a plan. Numbers are compared by value, so 0.30 is 0.3.
///
/// Throws core::InputError, one line, for an unknown axis (with the nearest name), a value that is not swept, a number
/// beyond the last cell, and where no cell or several are left.
const Cell& choose_cell(const Study& study, const Plan& plan, std::string_view text);

}  // namespace ridgeloc::studies
