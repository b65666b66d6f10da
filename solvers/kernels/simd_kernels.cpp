// Compiled once per instruction set.

#include "core/pack.hpp"
#include "solvers/kernels/kernels.hpp"

namespace ridgeloc::solvers {

template <>
Kernels kernels<core::native_isa>() {
  return kernels_over<core::NativeReal>();
}

}  // namespace ridgeloc::solvers
