#include "core/stream.hpp"

namespace ridgeloc::core {

namespace {

/// Absorbs text into a key, 16 bytes a step: the text is the counter and the key so far the Philox key. The length
/// goes first, so that ("ab", "c") and ("a", "bc") differ.
std::uint64_t absorb(std::uint64_t key, std::string_view text) {
  const auto mix = [&key](const RandomBlock& words) {
    const RandomBlock out = philox(words, key);
    key ^= (std::uint64_t{out[1]} << 32 | out[0]) ^ (std::uint64_t{out[3]} << 32 | out[2]);
  };
  const std::uint64_t size = text.size();
  mix({static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(size >> 32), 0, 0});
  for (std::size_t begin = 0; begin < text.size(); begin += 16) {
    RandomBlock words{};
    for (std::size_t i = begin; i < text.size() && i < begin + 16; ++i) {
      words[(i - begin) / 4] |= std::uint32_t{static_cast<unsigned char>(text[i])} << (i % 4 * 8);
    }
    mix(words);
  }
  return key;
}

}  // namespace

Stream::Stream(std::uint64_t seed, std::string_view purpose, std::string_view content)
    : key_(absorb(absorb(seed, purpose), content)) {}

}  // namespace ridgeloc::core
