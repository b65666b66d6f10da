#include "results/store/writing_cost.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <limits>
#include <utility>

#include "core/elapsed.hpp"
#include "results/blocks/expected_rows.hpp"
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

/// The first values of a column, and over again where there are not so many.
template <class T>
void resize_by_repeating(std::vector<T>& column, std::size_t size) {
  const std::size_t given = column.size();
  column.resize(given == 0 ? 0 : size);
  for (std::size_t i = given; i < column.size(); ++i) column[i] = column[i - given];
}

TrialColumns with_trials(TrialColumns columns, std::uint64_t trials) {
  columns.trials = trials;
  resize_by_repeating(columns.status, trials);
  for (std::vector<double>& metric : columns.metrics) resize_by_repeating(metric, trials);
  return columns;
}

/// As many trials of a cell as are to be kept, or as have room: of the last ones that have any a few.
std::uint64_t tried_trials(const TrialColumns& columns, std::uint64_t wanted, std::size_t room) {
  const std::size_t bytes_per_trial = std::max<std::size_t>(columns.value_bytes() / columns.trials, 1);
  return std::clamp<std::uint64_t>(wanted, 1, std::max<std::uint64_t>(room / bytes_per_trial, 1));
}

/// What writing one result took.
struct Measured {
  double wall_s = 0.0;
  double processor_s = 0.0;
  double bytes = 0.0;
  double part_bytes = 0.0;
};

/// Writes a part and seals it, twice: what else a machine does can only make it slower.
Measured written(const Header& header, const Part& part) {
  Measured least{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(), 0.0, 0.0};
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
    least.part_bytes = static_cast<double>(fs::file_size(folder.path() / "part.h5"));
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
  const auto sum = [&](double Amount::*member) {
    return fixed.*member + cells * per_cell.*member + bytes * per_byte.*member;
  };
  return {sum(&Amount::seconds), sum(&Amount::bytes), sum(&Amount::part_bytes)};
}

WritingCost try_writing(Header header, const std::vector<Row>& rows, std::vector<TrialColumns> columns,
                        const std::vector<std::uint64_t>& trials) {
  std::vector<std::size_t> cells;
  for (const Row& row : rows)
    if (cells.empty() || cells.back() != row.cell) cells.push_back(row.cell);
  const auto place_of = [&](std::size_t cell) {
    return static_cast<std::size_t>(std::ranges::find(cells, cell) - cells.begin());
  };
  std::vector<CellInfo> infos;
  for (const std::size_t cell : cells) infos.push_back(header.cells[cell]);
  header.cells = std::move(infos);
  const std::uint64_t block_trials = header.block_trials;
  const std::uint64_t kept_trials = header.kept_trials;
  // Every expected row is a block of its own, as long as it may be, and never a whole one, which would be merged.
  header.block_trials = std::max(block_trials, std::ranges::max(trials)) + 1;
  header.kept_trials = std::numeric_limits<std::uint64_t>::max();
  Header header_of_one = header;
  header_of_one.cells.resize(1);

  Part one{Ledger(header.block_trials), {}, {}};
  Part few{Ledger(header.block_trials), {}, {}};
  Part all{Ledger(header.block_trials), {}, {}};
  for (const Row& row : rows) {
    for (Row& expected : expected_rows(row, trials[row.cell], block_trials)) {
      expected.cell = place_of(row.cell);
      if (expected.cell == 0) one.ledger.insert(expected);
      few.ledger.insert(expected);
      all.ledger.insert(std::move(expected));
    }
  }
  WritingCost cost;
  std::size_t room = most_value_bytes;
  for (TrialColumns& kept : columns) {
    const std::uint64_t wanted = std::min(trials[kept.cell], kept_trials);
    kept.cell = place_of(kept.cell);
    cost.bytes_per_trial += static_cast<double>(kept.value_bytes()) / static_cast<double>(kept.trials * cells.size());
    few.columns.push_back(with_trials(kept, 1));
    if (kept.cell == 0) one.columns.push_back(few.columns.back());
    const std::uint64_t tried = tried_trials(kept, wanted, room);
    all.columns.push_back(with_trials(std::move(kept), tried));
    room -= std::min(room, all.columns.back().value_bytes());
  }

  const double more_bytes = value_bytes(all.columns) - value_bytes(few.columns);
  const auto more_cells = static_cast<double>(cells.size() - 1);
  const Measured by_one = written(header_of_one, one);
  const Measured by_few = more_cells > 0.0 ? written(header, few) : by_one;
  const Measured by_all = more_bytes > 0.0 ? written(header, all) : by_few;
  // The disk is waited for once a file, and for bytes. What cells cost is the processor's time for their datasets.
  cost.per_cell = {each(by_few.processor_s, by_one.processor_s, more_cells),
                   each(by_few.bytes, by_one.bytes, more_cells),
                   each(by_few.part_bytes, by_one.part_bytes, more_cells)};
  cost.fixed = {each(by_one.wall_s, cost.per_cell.seconds, 1.0), each(by_one.bytes, cost.per_cell.bytes, 1.0),
                each(by_one.part_bytes, cost.per_cell.part_bytes, 1.0)};
  const double for_bytes = std::max(by_all.wall_s - by_few.wall_s, by_all.processor_s - by_few.processor_s);
  cost.per_byte = {each(for_bytes, 0.0, more_bytes), each(by_all.bytes, by_few.bytes, more_bytes),
                   each(by_all.part_bytes, by_few.part_bytes, more_bytes)};
  return cost;
}

}  // namespace ridgeloc::results
