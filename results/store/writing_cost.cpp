#include "results/store/writing_cost.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <limits>
#include <utility>

#include "core/elapsed.hpp"
#include "results/store/block_union.hpp"
#include "results/store/part.hpp"
#include "results/store/result_seal.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

/// Bytes of values that are written at most to try it.
constexpr std::size_t most_value_bytes = std::size_t{32} << 20;

double value_bytes(const std::vector<TrialColumns>& list) {
  std::size_t bytes = 0;
  for (const TrialColumns& columns : list) bytes += columns.value_bytes();
  return static_cast<double>(bytes);
}

/// The columns of the first trial alone.
TrialColumns beginning(TrialColumns columns) {
  columns.trials = 1;
  columns.status.resize(std::min<std::size_t>(columns.status.size(), 1));
  for (std::vector<double>& metric : columns.metrics) metric.resize(std::min<std::size_t>(metric.size(), 1));
  return columns;
}

/// What writing one result took.
struct Measured {
  double wall_s = 0.0;
  double processor_s = 0.0;
  double bytes = 0.0;
};

/// Writes a part and seals it, twice: what else a machine does can only make it slower.
Measured written(const Header& header, const Part& part) {
  Measured least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0.0};
  for (int attempt = 0; attempt < 2; ++attempt) {
    const TemporaryFolder folder;
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t processor_begin = std::clock();
    write_part(folder.path() / "part.h5", header, part);
    BlockUnion blocks(header);
    blocks.add(read_part_blocks(folder.path() / "part.h5", header));
    write_result(folder.path() / "result.h5", header, blocks, {});
    least.wall_s = std::min(least.wall_s, core::seconds_since(begin));
    const auto ticks = static_cast<double>(std::clock() - processor_begin);
    least.processor_s = std::min(least.processor_s, ticks / static_cast<double>(CLOCKS_PER_SEC));
    least.bytes = static_cast<double>(fs::file_size(folder.path() / "result.h5"));
  }
  return least;
}

/// A difference of two measurements for each of so many things; nothing below zero, which is chance.
double each(double more, double less, double things) {
  return things > 0.0 ? std::max(more - less, 0.0) / things : 0.0;
}

}  // namespace

WritingCost::Amount WritingCost::of(double cells, double kept_trials) const {
  const double bytes = kept_trials * bytes_per_trial;
  return {fixed.seconds + cells * per_cell.seconds + bytes * per_byte.seconds,
          fixed.bytes + cells * per_cell.bytes + bytes * per_byte.bytes};
}

WritingCost try_writing(Header header, std::vector<Row> rows, std::vector<TrialColumns> columns) {
  std::vector<std::size_t> cells;
  for (const Row& row : rows)
    if (cells.empty() || cells.back() != row.cell) cells.push_back(row.cell);
  const auto place_of = [&](std::size_t cell) {
    return static_cast<std::size_t>(std::ranges::find(cells, cell) - cells.begin());
  };
  std::vector<CellInfo> infos;
  for (const std::size_t cell : cells) infos.push_back(header.cells[cell]);
  header.cells = std::move(infos);
  header.kept_trials = std::numeric_limits<std::uint64_t>::max();
  Header header_of_one = header;
  header_of_one.cells.resize(1);

  Part one{Ledger(header.block_trials), {}, {}};
  Part few{Ledger(header.block_trials), {}, {}};
  Part all{Ledger(header.block_trials), {}, {}};
  double trials = 0.0;
  for (Row& row : rows) {
    row.cell = place_of(row.cell);
    if (row.method == 0) trials += static_cast<double>(row.statistics.trials);
    if (row.cell == 0) one.ledger.insert(row);
    few.ledger.insert(row);
    all.ledger.insert(std::move(row));
  }
  double bytes = 0.0;
  std::size_t room = most_value_bytes;
  for (TrialColumns& kept : columns) {
    kept.cell = place_of(kept.cell);
    few.columns.push_back(beginning(kept));
    if (kept.cell == 0) one.columns.push_back(few.columns.back());
    bytes += static_cast<double>(kept.value_bytes());
    // Beyond what is tried, the first trial alone.
    all.columns.push_back(kept.value_bytes() <= room ? std::move(kept) : few.columns.back());
    room -= std::min(room, all.columns.back().value_bytes());
  }

  const double more_bytes = value_bytes(all.columns) - value_bytes(few.columns);
  const auto more_cells = static_cast<double>(cells.size() - 1);
  const Measured by_one = written(header_of_one, one);
  const Measured by_few = more_cells > 0.0 ? written(header, few) : by_one;
  const Measured by_all = more_bytes > 0.0 ? written(header, all) : by_few;
  WritingCost cost;
  cost.bytes_per_trial = bytes / trials;
  // The disk is waited for once a file, and for bytes. What cells cost is the processor's time for their datasets.
  cost.per_cell = {each(by_few.processor_s, by_one.processor_s, more_cells),
                   each(by_few.bytes, by_one.bytes, more_cells)};
  cost.fixed = {each(by_one.wall_s, cost.per_cell.seconds, 1.0), each(by_one.bytes, cost.per_cell.bytes, 1.0)};
  const double for_bytes = std::max(by_all.wall_s - by_few.wall_s, by_all.processor_s - by_few.processor_s);
  cost.per_byte = {each(for_bytes, 0.0, more_bytes), each(by_all.bytes, by_few.bytes, more_bytes)};
  return cost;
}

}  // namespace ridgeloc::results
