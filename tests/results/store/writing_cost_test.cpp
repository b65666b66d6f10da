#include "results/store/writing_cost.hpp"

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/sample_result.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::results;

namespace {

WritingCost cost_of_cells(const Header& header, std::size_t cells) {
  std::vector<Row> rows;
  std::vector<TrialColumns> columns;
  // From the last cell on: what is tried need be neither all cells nor the first.
  for (std::size_t cell = header.cells.size() - cells; cell < header.cells.size(); ++cell) {
    BlockSink sink = tests::sample_block(header, cell, 0, header.block_trials);
    for (Row& row : sink.take_rows()) rows.push_back(std::move(row));
    for (TrialColumns& kept : sink.take_columns()) columns.push_back(std::move(kept));
  }
  return try_writing(header, rows, std::move(columns), std::vector<std::uint64_t>(header.cells.size(), header.trials));
}

}  // namespace

TEST_CASE("what writing a few blocks costs says how large a result will be") {
  const tests::ScratchFolder folder;
  Header header = tests::sample_header();
  header.block_trials = 2048;
  header.trials = 2048;
  header.kept_trials = 2048;
  tests::write_sample(folder / "r.h5", header);
  const WritingCost cost = cost_of_cells(header, 3);
  // Of two solvers a status and two metrics, of the scene a metric.
  CHECK(cost.bytes_per_trial == 2 * (1 + 2 * 8) + 8);
  const auto size = static_cast<double>(std::filesystem::file_size(folder / "r.h5"));
  const WritingCost::Amount expected = cost.of(5, 5 * 2048);
  CHECK(expected.bytes == Approx(size).epsilon(0.1));
  CHECK(expected.seconds > 0.0);
}

TEST_CASE("a few trials say how large the result of many will be, its parts too") {
  const tests::ScratchFolder folder;
  Header header = tests::sample_header();
  header.block_trials = 2048;
  header.trials = 7 * 2048;
  header.kept_trials = GENERATE(0, 3000);
  tests::write_sample(folder / "r.h5", header);
  Header few = header;
  few.block_trials = 64;
  std::vector<Row> rows;
  std::vector<TrialColumns> columns;
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
    BlockSink sink = tests::sample_block(few, cell, 0, 64);
    for (Row& row : sink.take_rows()) rows.push_back(std::move(row));
    for (TrialColumns& kept : sink.take_columns()) columns.push_back(std::move(kept));
  }
  const std::vector<std::uint64_t> trials(header.cells.size(), header.trials);
  const WritingCost cost = try_writing(header, rows, std::move(columns), trials);
  const auto size = static_cast<double>(std::filesystem::file_size(folder / "r.h5"));
  const auto cells = static_cast<double>(header.cells.size());
  const WritingCost::Amount expected = cost.of(cells, cells * static_cast<double>(header.kept_trials));
  CHECK(expected.bytes < 1.5 * size);
  CHECK(size < 1.5 * expected.bytes);
  // Values lie in parts as they are.
  CHECK(expected.part_bytes >= cells * static_cast<double>(header.kept_trials) * cost.bytes_per_trial);
}

TEST_CASE("a single cell stands for all, and results without kept trials cost nothing for them") {
  Header header = tests::sample_header();
  const WritingCost one = cost_of_cells(header, 1);
  CHECK(one.fixed.bytes + one.per_cell.bytes > 0.0);
  header.kept_trials = 0;
  const WritingCost none = cost_of_cells(header, 3);
  CHECK(none.bytes_per_trial == 0.0);
  CHECK(none.per_byte.bytes == 0.0);
  CHECK(none.of(3, 1e6).bytes == none.of(3, 0).bytes);
}
