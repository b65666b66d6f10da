#pragma once

#include <numbers>

namespace ridgeloc::core {

/// Files speak of degrees, formulas of radians, random directions of turns.
inline constexpr double turns_per_degree = 1.0 / 360.0;
inline constexpr double radians_per_degree = std::numbers::pi / 180.0;
inline constexpr double mebibyte = 1048576.0;

}  // namespace ridgeloc::core
