#include "results/statistics/instruction_set.hpp"

namespace ridgeloc::results {

bool is_supported(InstructionSet set) {
  if (set == InstructionSet::Baseline) return true;
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

InstructionSet best_instruction_set() {
  return is_supported(InstructionSet::Avx2) ? InstructionSet::Avx2 : InstructionSet::Baseline;
}

}  // namespace ridgeloc::results
