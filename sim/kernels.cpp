#include "sim/kernels.hpp"

namespace ridgeloc::sim {

Kernels kernels(core::Isa isa) {
  using core::Isa;
  if constexpr (core::has_kernels(Isa::Avx512)) {
    if (isa == Isa::Avx512) return kernels<Isa::Avx512>();
  }
  if constexpr (core::has_kernels(Isa::Avx2)) {
    if (isa == Isa::Avx2) return kernels<Isa::Avx2>();
  }
  if constexpr (core::has_kernels(Isa::Baseline)) {
    return kernels<Isa::Baseline>();
  } else {
    return kernels_over<double>();
  }
}

}  // namespace ridgeloc::sim
