#pragma once

#include <cstdint>
#include <vector>

#include "results/blocks/block.hpp"
#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// What it costs to write a result: `fixed` + cells * `per_cell` + bytes of the values of kept trials * `per_byte`.
struct WritingCost {
  struct Amount {
    double seconds = 0.0;     ///< of one thread, waiting for the disk included
    double bytes = 0.0;       ///< of the result on the disk
    double part_bytes = 0.0;  ///< of its parts, which are there until it is sealed
  };
  Amount fixed;
  Amount per_cell;
  Amount per_byte;
  double bytes_per_trial = 0.0;  ///< of the values of a kept trial, over all methods

  Amount of(double cells, double kept_trials) const;
};

/// Writes results into the folder for temporary files, as a run does its own, and removes them: one of the first cell,
/// one of all cells with a single kept trial each, and one with the kept trials that they will have. Rows and columns
/// are those of a few trials; `trials` says how many each cell of the header will have, and what is written is as long.
/// A study whose cells fill the grid of its axes has a summary in the layout of cells here, which takes about as much.
/// Of the values at most some 32 MiB are written. Throws core::IoError if that cannot be. Precondition: `rows`, which
/// are not empty, and `columns` are of one block each of some cells of the header, sorted by cell; without kept trials
/// there are no columns.
WritingCost try_writing(Header header, const std::vector<Row>& rows, std::vector<TrialColumns> columns,
                        const std::vector<std::uint64_t>& trials);

}  // namespace ridgeloc::results
