// Compiled once per instruction set.

#include "core/pack.hpp"

#include "sim/kernels.hpp"

namespace ridgeloc::sim {

template <>
Kernels kernels<core::native_isa>() {
  return {place_objects<core::NativeReal>, draw_scores<core::NativeReal>, measure_ranges<core::NativeReal>};
}

}  // namespace ridgeloc::sim
