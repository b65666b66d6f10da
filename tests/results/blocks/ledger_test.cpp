#include "results/blocks/ledger.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <stdexcept>

#include "core/error.hpp"
#include "results/blocks/coverage.hpp"
#include "results/hdf5/hdf5.hpp"
#include "results/store/ledger_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/sample_study.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;

namespace {

Row block_row(const Header& header, std::uint64_t block, std::size_t method = 0) {
  return tests::sample_block(header, 0, block).take_rows()[method];
}

std::vector<Row> rows_of(const Ledger& ledger) {
  return {ledger.rows().begin(), ledger.rows().end()};
}

Header long_header(std::uint64_t blocks) {
  Header header = tests::sample_header();
  header.trials = blocks * header.block_trials;
  return header;
}

}  // namespace

TEST_CASE("a ledger keeps the maximal complete runs of blocks") {
  const Header header = long_header(8);
  Ledger ledger(header.block_trials);
  for (const std::uint64_t block : {0, 1, 2, 3, 4, 6, 7}) ledger.insert(block_row(header, block));
  std::vector<std::pair<std::uint64_t, std::uint64_t>> runs;
  for (const Row& row : ledger.rows()) runs.emplace_back(row.first_block, row.blocks);
  CHECK(runs == std::vector<std::pair<std::uint64_t, std::uint64_t>>{{0, 4}, {4, 1}, {6, 2}});
  CHECK(ledger.contains(0, 0, 3));
  CHECK_FALSE(ledger.contains(0, 0, 5));
  CHECK_FALSE(ledger.contains(0, 1, 3));
  CHECK_FALSE(ledger.contains(1, 0, 3));
}

TEST_CASE("a row is its left half merged with its right half") {
  const Header header = long_header(4);
  Ledger ledger(header.block_trials);
  std::vector<Row> blocks;
  for (std::uint64_t b = 0; b < 4; ++b) {
    blocks.push_back(block_row(header, b));
    ledger.insert(blocks.back());
  }
  const Statistics left = merge(blocks[0].statistics, blocks[1].statistics);
  const Statistics right = merge(blocks[2].statistics, blocks[3].statistics);
  REQUIRE(ledger.size() == 1);
  const Row row = rows_of(ledger).front();
  CHECK(row.statistics == merge(left, right));
  CHECK(ledger.total(0, 0) == row.statistics);
  for (std::uint64_t b = 0; b < 4; ++b) CHECK(row.digests[b] == blocks[b].digests[0]);
}

TEST_CASE("the rows of a ledger do not depend on the order of arrival") {
  const Header header = tests::sample_header();
  std::vector<Row> blocks;
  for (std::uint64_t b = 0; b < tests::sample_blocks; ++b) blocks.push_back(block_row(header, b));
  Ledger reference(header.block_trials);
  for (const Row& row : blocks) reference.insert(row);
  std::mt19937 engine(1);
  for (int repeat = 0; repeat < 50; ++repeat) {
    std::shuffle(blocks.begin(), blocks.end(), engine);
    Ledger ledger(header.block_trials);
    // Half of the blocks come as a ledger of their own, as from a part file.
    Ledger part(header.block_trials);
    for (std::size_t i = 0; i < blocks.size(); ++i) (i % 2 == 0 ? part : ledger).insert(blocks[i]);
    for (const Row& row : part.rows()) ledger.insert(row);
    REQUIRE(rows_of(ledger) == rows_of(reference));
    REQUIRE(ledger.bytes() == reference.bytes());
  }
}

TEST_CASE("rows of a ledger grow with the logarithm of the trials") {
  const Header header = long_header(1000);
  Ledger ledger(header.block_trials);
  for (std::uint64_t b = 0; b < 1000; ++b) ledger.insert(block_row(header, b));
  CHECK(ledger.size() == 6);  // 1000 = 512 + 256 + 128 + 64 + 32 + 8
  CHECK(ledger.total(0, 0).trials == header.trials);
}

TEST_CASE("a whole block supersedes a partial one, and not the other way round") {
  Header header = tests::sample_header();
  const Row partial = block_row(header, 5);
  header.trials = 6 * header.block_trials;
  const Row whole = block_row(header, 5);
  REQUIRE(partial.statistics.trials < whole.statistics.trials);
  for (const bool partial_first : {true, false}) {
    Ledger ledger(header.block_trials);
    ledger.insert(partial_first ? partial : whole);
    ledger.insert(partial_first ? whole : partial);
    CHECK(rows_of(ledger) == std::vector<Row>{whole});
  }
  Ledger merged(header.block_trials);
  merged.insert(block_row(header, 4));
  merged.insert(partial);
  CHECK(merged.size() == 2);
  merged.insert(whole);
  CHECK(merged.size() == 1);
}

TEST_CASE("a block given twice must have the same digest") {
  const Header header = long_header(4);
  Ledger ledger(header.block_trials);
  for (std::uint64_t b = 0; b < 4; ++b) ledger.insert(block_row(header, b));
  const std::vector<Row> before = rows_of(ledger);
  ledger.insert(block_row(header, 2));
  CHECK(rows_of(ledger) == before);

  Row other = block_row(header, 2);
  other.digests[0] ^= 1;
  CHECK_THROWS_AS(ledger.insert(other), core::IoError);
  CHECK(tests::lacking(tests::message_of([&] { ledger.insert(other); }), {"block 2 of cell 0, method 0"}) == "");

  Ledger reverse(header.block_trials);
  reverse.insert(other);
  CHECK_THROWS_AS(reverse.insert(before.front()), core::IoError);
}

TEST_CASE("a row that is no aligned run of blocks is refused") {
  const Header header = long_header(4);
  Ledger ledger(header.block_trials);
  Row row = block_row(header, 1);
  row.blocks = 2;
  CHECK_THROWS_AS(ledger.insert(row), std::invalid_argument);
  row = block_row(header, 1);
  row.statistics.trials = header.block_trials + 1;
  CHECK_THROWS_AS(ledger.insert(row), std::invalid_argument);
  row = block_row(header, 1);
  row.digests.clear();
  CHECK_THROWS_AS(ledger.insert(row), std::invalid_argument);
}

TEST_CASE("a coverage agrees with a plain list of the trials of each block") {
  constexpr std::uint64_t block_trials = 10;
  std::mt19937 engine(2);
  for (int repeat = 0; repeat < 50; ++repeat) {
    Coverage coverage;
    std::vector<std::uint64_t> trials(80, 0);
    for (int i = 0; i < 25; ++i) {
      const std::uint64_t first = engine() % 64;
      if (engine() % 2 == 0) {
        const std::uint64_t count = engine() % 8;
        coverage.insert(first, count, count * block_trials, block_trials);
        std::fill_n(trials.begin() + static_cast<std::ptrdiff_t>(first), count, block_trials);
      } else {
        const std::uint64_t shorter = 1 + engine() % (block_trials - 1);
        coverage.insert(first, 1, shorter, block_trials);
        trials[first] = std::max(trials[first], shorter);
      }
    }
    for (std::size_t b = 0; b < trials.size(); ++b) {
      REQUIRE(coverage.contains(b, trials[b] + 1) == (trials[b] == block_trials));
      if (trials[b] > 0) REQUIRE(coverage.contains(b, trials[b]));
    }
    for (const std::uint64_t asked : {0, 1, 95, 100, 333, 800}) {
      const std::uint64_t blocks = (asked + block_trials - 1) / block_trials;
      std::uint64_t there = 0;
      for (std::uint64_t b = 0; b < blocks; ++b)
        if (trials[b] >= std::min(block_trials, asked - b * block_trials)) ++there;
      REQUIRE(coverage.count(asked, block_trials) == there);
    }
    REQUIRE(coverage.trials(block_trials) == std::accumulate(trials.begin(), trials.end(), std::uint64_t{0}));
  }
}

TEST_CASE("rows of one method that cannot be added up are refused when they are read") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  Ledger ledger(header.block_trials);
  for (const std::uint64_t block : {0, 2}) {
    Row row = tests::sample_block(header, 0, block).take_rows()[0];
    REQUIRE_FALSE(row.statistics.events.empty());
    if (block == 2) row.statistics.events.clear();
    ledger.insert(std::move(row));
  }
  hdf5::File file = hdf5::File::create(folder / "a.h5");
  write_ledger(file, ledger, header.schema);
  CHECK(tests::lacking(tests::message_of([&] { read_ledger(file, header); }), {"with and without events"}) == "");
}
