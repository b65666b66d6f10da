#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace ridgeloc::core {

/// Instruction sets that kernels are compiled for. Numbers of two of them may differ in the last bits: only Avx2 and
/// Avx512 have a fused multiply-add, and with that the same numbers.
enum class Isa {
  Baseline,  ///< what every processor of the architecture has (SSE2 on x86-64, NEON on arm64)
  Avx2,      ///< AVX2 and FMA
  Avx512,    ///< AVX-512 F, CD, BW, DQ and VL
};
inline constexpr std::array<std::string_view, 3> isa_names = {"baseline", "avx2", "avx512"};
inline constexpr std::size_t isa_count = isa_names.size();

/// Whether this program holds kernels for it (RIDGELOC_ISA of CMake).
constexpr bool has_kernels(Isa isa) {
  switch (isa) {
    case Isa::Baseline:
#ifdef RIDGELOC_BASELINE
      return true;
#else
      return false;
#endif
    case Isa::Avx2:
#ifdef RIDGELOC_AVX2
      return true;
#else
      return false;
#endif
    case Isa::Avx512:
#ifdef RIDGELOC_AVX512
      return true;
#else
      return false;
#endif
  }
  return false;
}

/// Whether this program computes with it on this processor: it holds kernels for it and the processor has it. The
/// baseline always is supported: without kernels it is computed one trial at a time, to the same bits.
bool is_supported(Isa isa);

/// The widest supported one.
Isa best_isa();

/// The instruction set of that name.
std::optional<Isa> find_isa(std::string_view name);

inline std::string_view name_of(Isa isa) {
  return isa_names[static_cast<std::size_t>(isa)];
}

}  // namespace ridgeloc::core
