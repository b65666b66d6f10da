#pragma once

#include <cstdint>
#include <vector>

#include "results/blocks/block.hpp"
#include "studies/plan/plan.hpp"
#include "studies/run/work_queue.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// What a few blocks, run now, say about the cost of the whole study.
struct Pilot {
  double seconds_per_trial = 0.0;  ///< of one thread while all are at work, averaged over the cells
  double seconds_per_cell = 0.0;   ///< what preparing a cell takes and the audit of its first trials adds
  std::uint64_t trials = 0;        ///< trials that were run to find out
  /// With a stop rule: the trials at which each cell is likely to end, judged by its trials in the last round.
  std::vector<std::uint64_t> predicted_trials;
  /// Blocks of some cells with the values of their trials, by cell, to try what writing them costs.
  std::vector<results::Row> rows;
  std::vector<results::TrialColumns> columns;
};

/// Runs trials of the second block of each cell on all workers of a queue, round by round with growing numbers of
/// trials, first a single one, until `budget_s` is used up, one trial has taken longer, or a cell had as many as the
/// study gives it. Where not even one trial of each cell fits, cells spread evenly over all speak for the others. Then
/// the first trials of some cells, which are all audited, in half that time or one cell. Keeps no result.
Pilot run_pilot(const Study& study, const Plan& plan, double budget_s, WorkQueue& queue);

}  // namespace ridgeloc::studies
