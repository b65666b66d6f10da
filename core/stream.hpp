#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "core/philox.hpp"

namespace ridgeloc::core {

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

  /// The 128 random bits of draw `draw` of trial `trial`, alone or in lanes.
  RandomBlock<std::uint64_t> block(std::uint64_t trial, std::uint64_t draw) const {
    return philox<std::uint64_t>({trial, trial >> 32, draw, draw >> 32}, key_);
  }
  template <class Words>
  requires(!std::is_integral_v<Words>) RandomBlock<Words> block(const Words& trial, const Words& draw)
  const { return philox<Words>({trial, trial >> 32, draw, draw >> 32}, key_); }

 private:
  std::uint64_t key_ = 0;
};

}  // namespace ridgeloc::core
