#pragma once

#include <cstddef>

namespace ridgeloc::results {

/// Versions in which the loops over the values of a block are compiled. All give the same bits: a sum has eight
/// accumulators in every version, and only the number of registers that hold them differs.
enum class InstructionSet {
  Baseline,  ///< what the whole program is compiled for
  Avx2,      ///< x86-64 with registers of 32 bytes
};

bool is_supported(InstructionSet set);

/// The fastest version that this machine runs.
InstructionSet best_instruction_set();

#if defined(__x86_64__)
/// What is inlined into this function is compiled for AVX2; `Kernel::run` must therefore be `always_inline`, and so
/// must be what it calls.
template <template <std::size_t> class Kernel, typename... Args>
[[gnu::target("avx2")]] auto run_with_avx2(const Args&... args) {
  return Kernel<32>::run(args...);
}
#endif

/// Runs a kernel, a class template over the bytes of a register, in one of its versions.
/// Precondition: the set is supported.
template <template <std::size_t> class Kernel, typename... Args>
auto run_with([[maybe_unused]] InstructionSet set, const Args&... args) {
#if defined(__x86_64__)
  if (set == InstructionSet::Avx2) return run_with_avx2<Kernel>(args...);
#endif
  return Kernel<16>::run(args...);
}

}  // namespace ridgeloc::results
