#include "sim/kernels.hpp"

namespace ridgeloc::sim {

Kernels kernels(core::Isa isa) {
#if defined(__x86_64__)
  if (isa == core::Isa::Avx512) return kernels<core::Isa::Avx512>();
  if (isa == core::Isa::Avx2) return kernels<core::Isa::Avx2>();
#endif
  return kernels<core::Isa::Baseline>();
}

}  // namespace ridgeloc::sim
