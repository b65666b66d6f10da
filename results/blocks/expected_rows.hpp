#pragma once

#include <cstdint>
#include <vector>

#include "results/blocks/ledger.hpp"

namespace ridgeloc::results {

/// The rows that a ledger with blocks of `block_trials` trials will have of `trials` trials of a cell and method, as a
/// row of fewer lets expect: one for each run of blocks that is not merged with its neighbour. What they take is that
/// of their histograms, which grow: of the next trial the chance to fall into a bin without any is the share of trials
/// that are alone in theirs (Good 1953), which makes s ln(N / n) new bins of s trials that are alone among n.
///
/// Each is numbered as a block of its own, with one digest. Precondition: the row has trials.
std::vector<Row> expected_rows(const Row& row, std::uint64_t trials, std::uint64_t block_trials);

}  // namespace ridgeloc::results
