#include "studies/run/block_rounds.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "tests/support/catch.hpp"

using namespace ridgeloc::studies;

TEST_CASE("rounds have every block of every stretch once") {
  const std::vector<Stretch> stretches = {{0, 0, 37}, {1, 5, 6}, {2, 0, 0}, {3, 3, 100}, {4, 0, 37}};
  const std::uint64_t size = GENERATE(1, 3, 4, 200);
  const BlockRounds rounds(stretches, size);
  std::map<std::size_t, std::set<std::uint64_t>> seen;
  for (std::uint64_t number = 0; number < rounds.pieces(); ++number) {
    const Stretch piece = rounds.piece(number);
    REQUIRE(piece.end - piece.first <= size);
    for (std::uint64_t block = piece.first; block < piece.end; ++block) REQUIRE(seen[piece.place].insert(block).second);
  }
  for (const Stretch& stretch : stretches) {
    CHECK(seen[stretch.place].size() == stretch.end - stretch.first);
    if (stretch.first == stretch.end) continue;
    CHECK(*seen[stretch.place].begin() == stretch.first);
    CHECK(*seen[stretch.place].rbegin() == stretch.end - 1);
  }
  CHECK(BlockRounds({}, size).pieces() == 0);
}

TEST_CASE("after any number of pieces no cell has more than twice the blocks of another and a piece") {
  constexpr std::uint64_t size = 4;
  std::vector<Stretch> stretches;
  for (std::size_t cell = 0; cell < 9; ++cell) stretches.push_back({cell, 0, 1000});
  const BlockRounds rounds(stretches, size);
  CHECK(rounds.pieces() == 9 * 250);
  std::vector<std::uint64_t> blocks(stretches.size(), 0);
  std::size_t changes = 0;
  std::size_t last = stretches.size();
  for (std::uint64_t number = 0; number < rounds.pieces(); ++number) {
    const Stretch piece = rounds.piece(number);
    blocks[piece.place] += piece.end - piece.first;
    changes += piece.place == last ? 0 : 1;
    last = piece.place;
    const auto [fewest, most] = std::ranges::minmax(blocks);
    REQUIRE(most <= 2 * fewest + size);
  }
  // 1, 1, 2, 4, ..., 64 and the 122 that are left: nine rounds for 250 pieces.
  CHECK(changes <= 9 * stretches.size());
}
