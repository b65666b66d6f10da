#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "studies/plan/plan.hpp"

namespace ridgeloc::studies {

/// The cells that a text names, in their order: one by its number, or those that have certain values on axes of the
/// sweep, "points=5,depth_m=[1,10]". An empty text names all. Numbers are compared by value, so 0.30 is 0.3.
///
/// Throws core::InputError, one line, for an unknown axis (with the nearest name), a value that is not swept, a number
/// beyond the last cell, and where no cell is left.
std::vector<std::size_t> choose_cells(const results::Header& header, std::string_view text);

/// The only cell that a text names. Throws core::InputError, one line, where several are left too.
Cell choose_cell(const Plan& plan, std::string_view text);

}  // namespace ridgeloc::studies
