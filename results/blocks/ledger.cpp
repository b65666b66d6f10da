#include "results/blocks/ledger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>
#include <utility>

namespace ridgeloc::results {
namespace {

std::size_t bytes_of(const Row& row) {
  std::size_t bytes = sizeof(Row) + sizeof(std::uint64_t) * (row.digests.size() + row.statistics.events.size());
  for (const MetricStatistics& metric : row.statistics.metrics)
    bytes += sizeof(MetricStatistics) + sizeof(Histogram::Bin) * metric.histogram.bins().size();
  return bytes;
}

Row join(Row left, const Row& right) {
  left.blocks += right.blocks;
  left.statistics = merge(left.statistics, right.statistics);
  left.digests.insert(left.digests.end(), right.digests.begin(), right.digests.end());
  return left;
}

}  // namespace

BlockConflict::BlockConflict(std::size_t of_cell, std::size_t of_method, std::uint64_t number)
    : core::IoError(fmt::format("block {} of cell {}, method {} was computed twice with different numbers", number,
                                of_cell, of_method)),
      cell(of_cell),
      method(of_method),
      block(number) {}

void Ledger::require_valid(const Row& row) const {
  const std::uint64_t trials = row.statistics.trials;
  const bool is_aligned = std::has_single_bit(row.blocks) && row.first_block % row.blocks == 0;
  const bool is_complete = row.blocks == 1 ? trials > 0 && trials <= block_trials_ : is_full(row);
  if (!is_aligned || !is_complete || row.digests.size() != row.blocks)
    throw std::invalid_argument(fmt::format("{} blocks from {} with {} trials and {} digests are not a run of blocks",
                                            row.blocks, row.first_block, trials, row.digests.size()));
}

Ledger::Rows::const_iterator Ledger::covering(std::size_t cell, std::size_t method, std::uint64_t block) const {
  auto position = rows_.upper_bound({cell, method, block});
  if (position == rows_.begin()) return rows_.end();
  const Row& row = (--position)->second;
  const bool covers = row.cell == cell && row.method == method && block - row.first_block < row.blocks;
  return covers ? position : rows_.end();
}

bool Ledger::contains(std::size_t cell, std::size_t method, std::uint64_t block) const {
  return covering(cell, method, block) != rows_.end();
}

std::optional<Ledger::Block> Ledger::find(std::size_t cell, std::size_t method, std::uint64_t block) const {
  const auto position = covering(cell, method, block);
  if (position == rows_.end()) return std::nullopt;
  const Row& row = position->second;
  return Block{is_full(row) ? block_trials_ : row.statistics.trials, row.digests[block - row.first_block]};
}

void Ledger::require_equal(const Row& outer, const Row& inner) const {
  const auto begin = outer.digests.begin() + static_cast<std::ptrdiff_t>(inner.first_block - outer.first_block);
  const auto difference = std::mismatch(inner.digests.begin(), inner.digests.end(), begin);
  if (difference.first == inner.digests.end()) return;
  const auto offset = static_cast<std::uint64_t>(difference.first - inner.digests.begin());
  throw BlockConflict(inner.cell, inner.method, inner.first_block + offset);
}

bool Ledger::is_known(const Row& row) {
  const auto position = covering(row.cell, row.method, row.first_block);
  if (position == rows_.end()) return false;
  const Row& known = position->second;
  if (known.blocks < row.blocks) return false;
  if (known.statistics.trials < row.statistics.trials) return false;
  if (is_full(known) == is_full(row) && (is_full(row) || known.statistics.trials == row.statistics.trials))
    require_equal(known, row);
  return true;
}

Row Ledger::take(Rows::const_iterator position) {
  Row row = std::move(rows_.extract(position).mapped());
  bytes_ -= bytes_of(row);
  return row;
}

void Ledger::remove_parts_of(const Row& row) {
  auto position = rows_.lower_bound({row.cell, row.method, row.first_block});
  const auto end = rows_.lower_bound({row.cell, row.method, row.first_block + row.blocks});
  while (position != end) {
    const auto next = std::next(position);
    if (is_full(position->second)) require_equal(row, position->second);
    take(position);
    position = next;
  }
}

void Ledger::insert(Row row) {
  require_valid(row);
  if (is_known(row)) return;
  remove_parts_of(row);
  while (is_full(row)) {
    const std::uint64_t sibling_block = row.first_block ^ row.blocks;
    const auto sibling = rows_.find({row.cell, row.method, sibling_block});
    if (sibling == rows_.end() || sibling->second.blocks != row.blocks || !is_full(sibling->second)) break;
    Row other = take(sibling);
    row = sibling_block < row.first_block ? join(std::move(other), row) : join(std::move(row), other);
  }
  bytes_ += bytes_of(row);
  const Key key{row.cell, row.method, row.first_block};
  rows_.emplace(key, std::move(row));
}

Statistics Ledger::total(std::size_t cell, std::size_t method) const {
  Statistics sum;
  const auto end = rows_.lower_bound({cell, method + 1, 0});
  for (auto position = rows_.lower_bound({cell, method, 0}); position != end; ++position) {
    const Statistics& part = position->second.statistics;
    sum = sum.trials == 0 ? part : merge(sum, part);
  }
  return sum;
}

}  // namespace ridgeloc::results
