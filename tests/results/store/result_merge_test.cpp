#include "results/store/result_merge.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "results/store/result_file.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/sample_result.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;
namespace fs = std::filesystem;

namespace {

/// A result with those blocks of the sample study for which `wanted(cell, block)` holds.
template <class Wanted>
fs::path write_share(const fs::path& path, const Header& header, Wanted&& wanted) {
  ResultWriter writer(path, header);
  for (const auto& [cell, block] : tests::sample_tasks(header)) {
    if (!wanted(cell, block)) continue;
    std::vector<BlockSink> blocks;
    blocks.push_back(tests::sample_block(header, cell, block));
    writer.add(std::move(blocks));
  }
  writer.seal({});
  return path;
}

std::string merged_digest(const std::vector<fs::path>& inputs, const fs::path& output, const Header& header) {
  fs::remove(output);
  merge_results(inputs, output, header, {});
  return data_digest(output);
}

}  // namespace

TEST_CASE("shares merged in any order, with repetitions, are the whole result") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  tests::write_sample(folder / "whole.h5", header);
  std::vector<fs::path> inputs;
  for (std::size_t share = 0; share < 3; ++share)
    inputs.push_back(write_share(folder / ("share" + std::to_string(share) + ".h5"), header,
                                 [&](std::size_t cell, std::uint64_t block) { return (cell + block) % 3 == share; }));
  inputs.push_back(write_share(folder / "more.h5", header, [](std::size_t cell, std::uint64_t) { return cell < 3; }));
  std::ranges::sort(inputs);
  int orders = 0;
  do {
    CHECK(merged_digest(inputs, folder / "merged.h5", header) == data_digest(folder / "whole.h5"));
    ++orders;
  } while (std::ranges::next_permutation(inputs).found);
  CHECK(orders == 24);
}

TEST_CASE("of a block that is there twice the longer one counts") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  Header shorter = header;
  shorter.trials -= tests::sample_block_trials + 3;
  tests::write_sample(folder / "whole.h5", header);
  tests::write_sample(folder / "shorter.h5", shorter);
  for (const auto& inputs : {std::vector<fs::path>{folder / "shorter.h5", folder / "whole.h5"},
                             std::vector<fs::path>{folder / "whole.h5", folder / "shorter.h5"}})
    CHECK(merged_digest(inputs, folder / "merged.h5", header) == data_digest(folder / "whole.h5"));
}

TEST_CASE("a block with equal length and other numbers is fatal and named") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  tests::write_sample(folder / "a.h5", header);
  // Another program's numbers for cell 3: those of a cell with another hash.
  Header other = header;
  other.cells[3].hash = "elsewhere";
  const fs::path forged = folder / "c.h5";
  {
    ResultWriter writer(forged, header);
    BlockSink foreign = tests::sample_block(other, 3, 1);
    std::vector<BlockSink> blocks;
    blocks.push_back(std::move(foreign));
    writer.add(std::move(blocks));
    writer.seal({});
  }
  const std::string message = tests::message_of([&] {
    merge_results({folder / "a.h5", forged}, folder / "m.h5", header, {});
  });
  CHECK(tests::lacking(message, {"c.h5", "block 1 of cell 3", "points = 4", "method ols", "other numbers"}) == "");
  CHECK_THROWS_AS(merge_results({folder / "a.h5", forged}, folder / "m.h5", header, {}), core::IoError);
  CHECK_FALSE(fs::exists(folder / "m.h5"));
}

TEST_CASE("results that may not be merged are refused") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  tests::write_sample(folder / "a.h5", header);
  Header other = header;
  std::string reason;
  SECTION("another study") {
    other.study_hash = "f";
    reason = "another study";
  }
  SECTION("another instruction set") {
    other.isa = "avx2";
    reason = "instruction set baseline";
  }
  SECTION("a cell that is not in the study") {
    other.cells.pop_back();
    reason = "holds a cell that the study has not";
  }
  SECTION("the output is there") {
    tests::write_sample(folder / "m.h5", header);
    reason = "exists";
  }
  const std::string message = tests::message_of([&] { merge_results({folder / "a.h5"}, folder / "m.h5", other, {}); });
  CHECK(tests::lacking(message, {reason}) == "");
  CHECK_THROWS_AS(merge_results({folder / "a.h5"}, folder / "m.h5", other, {}), core::InputError);
}

TEST_CASE("what a result was merged from is kept, however many it were") {
  const tests::ScratchFolder folder;
  const Header header = tests::sample_header();
  tests::write_sample(folder / "a.h5", header);
  Provenance provenance;
  for (int i = 0; i < 10'000; ++i) provenance.contributions.push_back("share " + std::to_string(i));
  merge_results({folder / "a.h5"}, folder / "merged.h5", header, provenance);
  CHECK(read_provenance(folder / "merged.h5").contributions == provenance.contributions);
  CHECK(contributions_of(folder / "merged.h5") == provenance.contributions);
}

TEST_CASE("instruction sets may be mixed if that is asked for") {
  const tests::ScratchFolder folder;
  Header header = tests::sample_header();
  write_share(folder / "a.h5", header, [](std::size_t cell, std::uint64_t) { return cell < 2; });
  header.isa = "avx2";
  write_share(folder / "b.h5", header, [](std::size_t cell, std::uint64_t) { return cell >= 2; });
  header.isa = mixed_isa;
  merge_results({folder / "a.h5", folder / "b.h5"}, folder / "m.h5", header, {});
  CHECK(read_result_header(folder / "m.h5").isa == "mixed");
  CHECK(read_result(folder / "m.h5").of(4, 0).trials == tests::sample_trials);
}
