#include "core/isa.hpp"

#include <algorithm>

namespace ridgeloc::core {

namespace {

bool processor_has(Isa isa) {
#if defined(__x86_64__)
  switch (isa) {
    case Isa::Baseline:
      return true;
    case Isa::Avx2:
      return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
             __builtin_cpu_supports("bmi2") != 0;
    case Isa::Avx512:
      return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512cd") != 0 &&
             __builtin_cpu_supports("avx512bw") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
             __builtin_cpu_supports("avx512vl") != 0 && processor_has(Isa::Avx2);
  }
#endif
  return isa == Isa::Baseline;
}

}  // namespace

bool is_supported(Isa isa) {
  return isa == Isa::Baseline || (has_kernels(isa) && processor_has(isa));
}

Isa best_isa() {
  if (is_supported(Isa::Avx512)) return Isa::Avx512;
  return is_supported(Isa::Avx2) ? Isa::Avx2 : Isa::Baseline;
}

std::optional<Isa> find_isa(std::string_view name) {
  const auto found = std::ranges::find(isa_names, name);
  if (found == isa_names.end()) return std::nullopt;
  return static_cast<Isa>(found - isa_names.begin());
}

}  // namespace ridgeloc::core
