#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "studies/plan/plan.hpp"

namespace ridgeloc::studies {

inline constexpr std::uint64_t max_shards = 1'000'000;

/// Share number `number` of `count` equal ones, counted from 1.
struct Shard {
  std::uint64_t number = 1;
  std::uint64_t count = 1;
};

/// What of a plan one run is to compute: the blocks of some cells for some methods, up to a number of trials per cell,
/// or one share of these blocks.
///
/// Shares need no communication: the blocks of a cell are cut into at least 16 runs per share, as long as there are so
/// many, and the runs of all cells are dealt in turn. Runs are of 2^k blocks and aligned, so that the blocks of a share
/// join in its result.
struct Assignment {
  std::vector<std::size_t> cells;    ///< of the plan, ascending
  std::vector<std::size_t> methods;  ///< of the header, ascending; extra labels among them
  std::uint64_t trials = 0;          ///< per cell
  std::uint64_t block_trials = 0;
  Shard shard;

  std::uint64_t blocks_per_cell() const { return (trials + block_trials - 1) / block_trials; }
  /// Trials of a block: all, or in the last block what is left.
  TrialRange range(std::uint64_t block) const;
  /// Whether the share has the block of the cell at that place in `cells`.
  bool contains(std::size_t place, std::uint64_t block) const;
  /// Blocks of the share, over all cells.
  std::uint64_t blocks() const { return blocks(blocks_per_cell()); }
  /// Of these, the ones among the first `per_cell` of each cell.
  std::uint64_t blocks(std::uint64_t per_cell) const;

 private:
  std::uint64_t run_blocks() const;
};

/// All of a plan.
Assignment everything(const Plan& plan);

/// What `asked` has, as `plan` numbers it. Precondition: `plan` has every cell and method of `asked`.
Assignment assignment_of(const Plan& plan, const Plan& asked, const Shard& shard);

}  // namespace ridgeloc::studies
