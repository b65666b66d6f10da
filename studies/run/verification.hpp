#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "results/blocks/ledger.hpp"
#include "studies/plan/plan.hpp"
#include "studies/run/work_queue.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// A block of a result, for all its methods.
struct BlockNumber {
  std::size_t cell = 0;
  std::uint64_t block = 0;

  friend auto operator<=>(const BlockNumber&, const BlockNumber&) = default;
};

/// The blocks of a ledger that any method has, sorted.
std::vector<BlockNumber> all_blocks(const results::Ledger& ledger);

/// `count` of different blocks, or all if there are no more, sorted. The same for the same seed.
std::vector<BlockNumber> random_choice(std::vector<BlockNumber> blocks, std::size_t count, std::uint64_t seed);

/// A method whose block is not what the ledger says.
struct BlockDifference {
  BlockNumber where;
  std::size_t method = 0;
};

/// Computes blocks again and compares the digests of all methods that the ledger has.
/// Precondition: the ledger is of a result of the plan, and has the blocks.
std::vector<BlockDifference> differing_blocks(const Study& study, const Plan& plan, const results::Ledger& ledger,
                                              const std::vector<BlockNumber>& blocks, WorkQueue& queue);

}  // namespace ridgeloc::studies
