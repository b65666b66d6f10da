#include "studies/study/audit_sample.hpp"

namespace ridgeloc::studies {

std::vector<std::size_t> AuditSample::slots(TrialRange range) const {
  constexpr std::uint64_t words = 4;  // of a random block: one for each of four trials
  constexpr std::uint64_t low_word = 0xffffffffU;
  std::vector<std::size_t> slots;
  if (!(share_ > 0.0)) return slots;
  const double limit = share_ * 0x1p32;
  core::RandomBlock<std::uint64_t> bits{};
  for (std::size_t slot = 0; slot < range.count; ++slot) {
    const std::uint64_t trial = range.first + slot;
    if (slot == 0 || trial % words == 0) bits = stream_.block(trial / words, 0);
    if (trial < always_audited || static_cast<double>(bits[trial % words] & low_word) + 0.5 < limit)
      slots.push_back(slot);
  }
  return slots;
}

}  // namespace ridgeloc::studies
