#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/schema/schema.hpp"
#include "results/statistics/statistics.hpp"

namespace ridgeloc::studies {

/// When a cell has enough trials: as soon as the Monte Carlo standard error of a statistic is below a target, for every
/// method that counts.
struct StopRule {
  std::string metric;                ///< or event
  std::string statistic = "mean";    ///< "mean", "median" or "rms"; of what is yes or no always the rate
  std::vector<std::string> methods;  ///< labels; empty: all solvers that report the metric
  double target = 0.0;               ///< in the unit of the metric, or a share of the statistic itself
  bool is_relative = false;
  std::uint64_t min_trials = 0;
  std::uint64_t max_trials = 0;
  double max_cost = 0.0;  ///< of all cells together, as the experiment's `TrialCost` counts, or in trials; 0: no limit
};

/// The numbers of blocks at which a cell is looked at: from those of `min_trials` on, each a quarter of an octave (19
/// %) above the one before, to those of `max_trials`, of which the last one has what is left for it; the others are
/// whole. Fixed beforehand, so that a run that goes on needs no memory of what the last one has seen: whoever went
/// beyond a look has found it not enough.
std::vector<std::uint64_t> looks(const StopRule& rule, std::uint64_t block_trials);

/// How far a cell is from what the rule asks for.
struct Precision {
  double error_over_target = 0.0;  ///< the largest of all methods; NaN where an error is not known
  bool is_reliable = true;         ///< whether all these errors are themselves reliable (`SummaryRow::trusted`)

  bool is_enough() const { return is_reliable && error_over_target <= 1.0; }
};

/// Of the trials of a cell; `statistics` by method. The error of a rate is the half width of its Wilson interval
/// over 1.96, which also knows rates of 0 and 1.
Precision precision_of(const StopRule& rule, const results::Header& header,
                       const std::vector<results::Statistics>& statistics);

/// How much the cells gain together, per unit of cost, if this one goes on. With a standard error of r times its target
/// (squared, r^2, it falls with 1 over the trials) after a cost of c that is r^2 / c. Going on where it is the largest
/// makes the sum of r^2 over the cells the smallest for a given cost: as many trials for each as its standard deviation
/// over the root of the cost of its trials. Infinite where the error is not known; an error that is not reliable counts
/// as no better than the target.
double priority(const Precision& precision, double cost);

/// The trials at which a cell is likely to end whose first `trials` trials came to a precision: the first look at which
/// the error, as it falls with the root of the trials, is below the target.
std::uint64_t predicted_trials(const StopRule& rule, const Precision& precision, std::uint64_t trials,
                               std::uint64_t block_trials);

}  // namespace ridgeloc::studies
