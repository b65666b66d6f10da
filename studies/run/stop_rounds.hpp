#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "results/statistics/statistics.hpp"
#include "studies/plan/assignment.hpp"
#include "studies/plan/plan.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// Blocks first, first + 1, ..., end - 1 of the cell at a place of an assignment.
struct Stretch {
  std::size_t place = 0;
  std::uint64_t first = 0;
  std::uint64_t end = 0;
};

/// What is there of a result, for whoever decides what is to be computed next.
class FinishedBlocks {
 public:
  /// How far a cell is: how many of the blocks that `trials` trials make all methods have from the first on without a
  /// gap (more if there are more whole ones), and one past the last block that any has.
  struct Extent {
    std::uint64_t unbroken = 0;
    std::uint64_t end = 0;
  };

  virtual ~FinishedBlocks() = default;
  virtual Extent extent(std::size_t cell, std::uint64_t trials, const std::vector<std::size_t>& methods) const = 0;
  /// Of all trials that a method has in a cell.
  virtual results::Statistics statistics(std::size_t cell, std::size_t method) const = 0;
};

/// Whether a method of a header counts towards `StopRule::max_cost`, its trials being run for it. Without methods an
/// experiment reports under its labels alone, and these are what runs.
bool has_cost(const Study& study, const results::Header& header, std::size_t method);

/// What a stop rule asks for, round by round. A round depends on the finished blocks alone, never on time or threads,
/// and not on how they came about: a run that was interrupted goes on as if it had not been.
///
/// Without `StopRule::max_cost` all cells that are not known well enough go to their next look, each by its own trials
/// alone. With it they do so one after the other, first the cell whose priority (see there) is the largest, until the
/// cost of all that there is reaches the limit; only the first look of every cell is not subject to it.
class StopRounds {
 public:
  /// All of them must outlive this one. Precondition: the study has a stop rule, and the trials of the assignment are
  /// its `max_trials`.
  StopRounds(const Study& study, const Plan& plan, const Assignment& assignment, const FinishedBlocks& finished);

  /// The next round, after all blocks of the last one have been added; empty when the rule is satisfied.
  std::vector<Stretch> next();

 private:
  /// What is known of a cell after some blocks.
  struct Known {
    std::uint64_t blocks = 0;
    double cost = 0.0;
    Precision precision;
  };
  FinishedBlocks::Extent extent(std::size_t place) const;
  const Known& known(std::size_t place, std::uint64_t blocks);
  std::vector<Stretch> most_worthwhile(const std::vector<Stretch>& wanting);

  const Study& study_;
  const Plan& plan_;
  const Assignment& assignment_;
  const FinishedBlocks& finished_;
  std::vector<std::uint64_t> looks_;
  std::vector<Known> known_;  ///< by place; of the last look that was asked about
};

}  // namespace ridgeloc::studies
