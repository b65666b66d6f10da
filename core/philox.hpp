#pragma once

#include <array>
#include <cstdint>

#include "core/real.hpp"

namespace ridgeloc::core {

/// Four 32-bit random words per lane, each in the lower half of 64 bits. What the upper halves hold is unspecified.
template <class Words>
using RandomBlock = std::array<Words, 4>;

/// Philox4x32-10 (Salmon et al., SC 2011), the low word of the key first; word for word the numbers of Random123. Of
/// the counter only the lower halves count.
template <class Words = std::uint64_t>
RandomBlock<Words> philox(RandomBlock<Words> c, std::uint64_t key) {
  constexpr std::uint64_t multiplier_0 = 0xD2511F53U;
  constexpr std::uint64_t multiplier_1 = 0xCD9E8D57U;
  constexpr std::uint32_t weyl_0 = 0x9E3779B9U;
  constexpr std::uint32_t weyl_1 = 0xBB67AE85U;
  auto key_0 = static_cast<std::uint32_t>(key);
  auto key_1 = static_cast<std::uint32_t>(key >> 32);
  for (int round = 0; round < 10; ++round) {
    const Words product_0 = multiply_low_words(c[0], Words(multiplier_0));
    const Words product_1 = multiply_low_words(c[2], Words(multiplier_1));
    c = {(product_1 >> 32) ^ c[1] ^ Words(key_0), product_1, (product_0 >> 32) ^ c[3] ^ Words(key_1), product_0};
    key_0 += weyl_0;
    key_1 += weyl_1;
  }
  return c;
}

}  // namespace ridgeloc::core
