#pragma once

#include <Random123/philox.h>

#include <array>
#include <cstdint>
#include <string_view>

namespace ridgeloc::core {

/// Four 32-bit random words: one output of Philox4x32-10.
using RandomBlock = std::array<std::uint32_t, 4>;

/// Philox4x32-10, the low word of the key first.
inline RandomBlock philox(const RandomBlock& counter, std::uint64_t key) {
  const r123::Philox4x32::ctr_type c = {{counter[0], counter[1], counter[2], counter[3]}};
  const r123::Philox4x32::key_type k = {{static_cast<std::uint32_t>(key), static_cast<std::uint32_t>(key >> 32)}};
  const auto out = r123::Philox4x32{}(c, k);
  return {out[0], out[1], out[2], out[3]};
}

/// Random numbers by identity: a value is a pure function of (seed, purpose, content, trial, draw).
///
/// The 64-bit key is a hash of the study seed, the purpose of the stream ("scene", "noise", ...) and the content of
/// just those factors that the stream depends on; the 128-bit counter is (trial, draw). No key ever contains a cell
/// index, a number of points, a thread or a clock, so adding a point to a sweep changes no other number.
/// Generator: Philox4x32-10 (Salmon et al., SC 2011). A stream has no state: any thread may use any copy.
class Stream {
 public:
  Stream() = default;

  /// `content` is the canonical text of the factors that the numbers depend on (may be empty).
  Stream(std::uint64_t seed, std::string_view purpose, std::string_view content = {});

  std::uint64_t key() const { return key_; }

  /// The 128 random bits of draw `draw` of trial `trial`.
  RandomBlock block(std::uint64_t trial, std::uint64_t draw) const {
    return philox({static_cast<std::uint32_t>(trial), static_cast<std::uint32_t>(trial >> 32),
                   static_cast<std::uint32_t>(draw), static_cast<std::uint32_t>(draw >> 32)},
                  key_);
  }

 private:
  std::uint64_t key_ = 0;
};

}  // namespace ridgeloc::core
