#pragma once

#include <cstdint>
#include <vector>

#include "studies/plan/plan.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// What a few blocks, run now, say about the cost of the whole study.
struct Pilot {
  double seconds_per_trial = 0.0;  ///< of one thread, averaged over the cells
  double seconds_per_cell = 0.0;   ///< what the audit of the first trials adds, of the first cell
  std::uint64_t trials = 0;        ///< trials that were run to find out
  /// With a stop rule: the trials at which each cell is likely to end, judged by its trials in the last round.
  std::vector<std::uint64_t> predicted_trials;
};

/// Runs trials of the second block of each cell on one thread, round by round with growing numbers of trials, first a
/// single one, until `budget_s` is used up or one trial has taken longer. Where not even one trial of each cell fits,
/// cells spread evenly over all speak for the others. Then the first trials of the first cell, which are all audited.
/// Keeps no result.
Pilot run_pilot(const Study& study, const Plan& plan, double budget_s);

}  // namespace ridgeloc::studies
