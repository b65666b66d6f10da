#pragma once

#include <cstdint>
#include <vector>

#include "core/isa.hpp"
#include "results/schema.hpp"
#include "studies/study.hpp"

namespace ridgeloc::studies {

/// What a study amounts to: its cells, each cut into blocks, and what the result will say of itself.
struct Plan {
  std::vector<Cell> cells;
  std::uint64_t blocks_per_cell = 0;
  core::Isa isa = core::Isa::Baseline;  ///< what the blocks are computed with
  results::Header header;

  /// Trials of block `block` of any cell: a block, or what is left of the total in the last one.
  TrialRange range(std::uint64_t block) const;
};

/// Lays a study out. Cells are numbered along the axes, the last axis fastest, zipped axes as one.
/// Throws core::InputError when `exclude` leaves no cell.
Plan make_plan(const Study& study, core::Isa isa = core::Isa::Baseline);

/// Bytes of per-trial columns that one trial takes, over all methods.
std::uint64_t bytes_per_trial(const Study& study);

}  // namespace ridgeloc::studies
