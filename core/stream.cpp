#include "core/stream.hpp"

namespace ridgeloc::core {

namespace {

/// Absorbs text into a key, 16 bytes a step: the text is the counter and the key so far the Philox key. The length
/// goes first, so that ("ab", "c") and ("a", "bc") differ.
std::uint64_t absorb(std::uint64_t key, std::string_view text) {
  const auto mix = [&key](const RandomBlock<std::uint64_t>& words) {
    const RandomBlock<std::uint64_t> out = philox(words, key);
    constexpr std::uint64_t low_word = 0xffffffffU;
    key ^= (out[1] << 32 | (out[0] & low_word)) ^ (out[3] << 32 | (out[2] & low_word));
  };
  const std::uint64_t size = text.size();
  mix({size, size >> 32, 0, 0});
  for (std::size_t begin = 0; begin < text.size(); begin += 16) {
    RandomBlock<std::uint64_t> words{};
    for (std::size_t i = begin; i < text.size() && i < begin + 16; ++i) {
      words[(i - begin) / 4] |= std::uint64_t{static_cast<unsigned char>(text[i])} << (i % 4 * 8);
    }
    mix(words);
  }
  return key;
}

}  // namespace

Stream::Stream(std::uint64_t seed, std::string_view purpose, std::string_view content)
    : key_(absorb(absorb(seed, purpose), content)) {}

}  // namespace ridgeloc::core
