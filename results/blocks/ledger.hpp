#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <ranges>
#include <tuple>
#include <vector>

#include "core/error.hpp"
#include "results/statistics/statistics.hpp"

namespace ridgeloc::results {

/// A block that was computed twice with different numbers.
class BlockConflict : public core::IoError {
 public:
  BlockConflict(std::size_t of_cell, std::size_t of_method, std::uint64_t number);

  const std::size_t cell;
  const std::size_t method;
  const std::uint64_t block;
};

/// What one method produced over a run of blocks of one cell.
struct Row {
  std::size_t cell = 0;
  std::size_t method = 0;
  std::uint64_t first_block = 0;
  std::uint64_t blocks = 1;  ///< a power of two that divides first_block
  Statistics statistics;
  std::vector<std::uint64_t> digests;  ///< one per block, in order

  friend bool operator==(const Row&, const Row&) = default;
};

/// The set of finished blocks of a study, with their statistics.
///
/// Full blocks are merged over one fixed binary tree of block numbers: as soon as both halves of an aligned
/// run [a 2^k, (a + 1) 2^k) are there, they become one row, left merged with right. The rows that are kept
/// are the maximal complete runs, so that their number grows with the logarithm of the trials and no value
/// depends on the order in which blocks arrive. A last block with fewer trials stays a row of its own until
/// the whole block supersedes it.
class Ledger {
 public:
  explicit Ledger(std::uint64_t block_trials) : block_trials_(block_trials) {}

  /// Adds a run of blocks; blocks that are known already are compared by their digests and left as they are.
  /// Throws std::invalid_argument for a row that is not an aligned run, and BlockConflict if a block was
  /// computed before with the same number of trials and another digest.
  void insert(Row row);

  bool contains(std::size_t cell, std::size_t method, std::uint64_t block) const;

  /// What is known of one block; none if it is not there.
  struct Block {
    std::uint64_t trials = 0;
    std::uint64_t digest = 0;
  };
  std::optional<Block> find(std::size_t cell, std::size_t method, std::uint64_t block) const;

  /// All trials of a method in a cell: its rows merged from left to right. Without any, `trials` is 0.
  Statistics total(std::size_t cell, std::size_t method) const;

  /// Rows in order of cell, method and first block.
  auto rows() const { return std::views::values(rows_); }
  std::size_t size() const { return rows_.size(); }
  std::uint64_t block_trials() const { return block_trials_; }

  /// Approximate memory in use.
  std::size_t bytes() const { return bytes_; }

 private:
  using Key = std::tuple<std::size_t, std::size_t, std::uint64_t>;
  using Rows = std::map<Key, Row>;

  bool is_full(const Row& row) const { return row.statistics.trials == row.blocks * block_trials_; }
  void require_valid(const Row& row) const;
  Rows::const_iterator covering(std::size_t cell, std::size_t method, std::uint64_t block) const;
  bool is_known(const Row& row);
  void remove_parts_of(const Row& row);
  void require_equal(const Row& outer, const Row& inner) const;
  Row take(Rows::const_iterator position);

  std::uint64_t block_trials_;
  Rows rows_;
  std::size_t bytes_ = 0;
};

}  // namespace ridgeloc::results
