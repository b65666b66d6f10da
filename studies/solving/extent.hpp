#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/problem.hpp"

namespace ridgeloc::studies {

/// A position (m).
using Place = std::array<double, core::position_parameters>;

/// How some positions lie.
struct Extent {
  Place mean{};
  std::size_t dimensions = 0;  ///< 0 a point, 1 a line, 2 a plane, to a millionth of the largest extent
  Place normal{};              ///< of length 1, in the direction in which they extend least, upwards
};

/// The extent of positions; `from_above`: of their x and y alone, and then the normal lies in that plane.
Extent extent_of(std::span<const Place> places, bool from_above);

}  // namespace ridgeloc::studies
