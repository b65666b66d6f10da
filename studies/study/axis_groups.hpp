#pragma once

#include <cstddef>
#include <vector>

#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// Axes of the sweep, by number, that move together: each zipped group, and every other axis for itself, by first axis.
std::vector<std::vector<std::size_t>> axis_groups(const Study& study);

/// How many cells the axes make together before any is excluded; zipped axes count as one. A real number, since axes
/// that are yet to be refused may make more than any whole one holds.
double crossed_cells(const Study& study);

/// Throws core::InputError, one line, where these are more than `max_cells`, which no reader of the study accepts.
void refuse_too_many_cells(const Study& study);

}  // namespace ridgeloc::studies
