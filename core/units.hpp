#pragma once

namespace ridgeloc::core {

/// Files speak of degrees, kernels of turns.
inline constexpr double turns_per_degree = 1.0 / 360.0;
inline constexpr double mebibyte = 1048576.0;

}  // namespace ridgeloc::core
