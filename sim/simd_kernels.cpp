// Compiled once per instruction set.

#include "core/pack.hpp"

#include "sim/kernels.hpp"

namespace ridgeloc::sim {

template <>
Kernels kernels<core::native_isa>() {
  return kernels_over<core::NativeReal>();
}

}  // namespace ridgeloc::sim
