#include "core/stream.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>

#include "tests/support/catch.hpp"

using namespace ridgeloc::core;

namespace {

using Block = std::array<std::uint32_t, 4>;

/// The words of a block: what lies above them is unspecified.
Block words(const RandomBlock<std::uint64_t>& block) {
  Block out;
  std::ranges::transform(block, out.begin(), [](std::uint64_t word) { return static_cast<std::uint32_t>(word); });
  return out;
}

}  // namespace

TEST_CASE("Philox4x32-10 gives the known answers of its authors") {
  // kat_vectors of Random123, philox4x32 with 10 rounds.
  CHECK(words(philox({0, 0, 0, 0}, 0)) == Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8});
  CHECK(words(philox({0xffffffff, 0xffffffff, 0xffffffff, 0xffffffff}, 0xffffffffffffffff)) ==
        Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd});
  CHECK(words(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0x299f31d0a4093822)) ==
        Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1});
}

TEST_CASE("A block's counter is (trial, draw), low words first") {
  const Stream stream(1, "scene");
  CHECK(words(stream.block(0x0000000500000007, 0x0000000200000003)) == words(philox({7, 5, 3, 2}, stream.key())));
}

TEST_CASE("Streams that differ in seed, purpose or content have different keys") {
  std::set<std::uint64_t> keys;
  std::size_t streams = 0;
  for (const std::uint64_t seed : {0, 1, 2018}) {
    for (const char* purpose : {"", "scene", "noise", "scene "}) {
      for (const char* content : {"", "a", "depth 1 10", "depth 1 10 and more than sixteen bytes"}) {
        keys.insert(Stream(seed, purpose, content).key());
        ++streams;
      }
    }
  }
  CHECK(keys.size() == streams);
  CHECK(Stream(1, "ab", "c").key() != Stream(1, "a", "bc").key());
}

TEST_CASE("A stream is the same on every machine") {
  CHECK(Stream(2018, "scene", "content").key() == 0x75f35d6aea4c97d9);
}
