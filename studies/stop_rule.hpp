#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/schema.hpp"
#include "results/statistics.hpp"

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
};

/// The numbers of blocks at which a cell is looked at: from those of `min_trials` on, each a quarter of an octave (19 %)
/// above the one before, to those of `max_trials`; both rounded up to whole blocks. Fixed beforehand, so that a run that
/// goes on needs no memory of what the last one has seen: whoever went beyond a look has found it not enough.
std::vector<std::uint64_t> looks(const StopRule& rule, std::uint64_t block_trials);

/// Whether the trials of a cell are enough. `statistics` by method. An error counts only if it is itself reliable
/// (`SummaryRow::trusted`); that of a rate is the half width of its Wilson interval, which also knows rates of 0 and 1.
bool is_reached(const StopRule& rule, const results::Header& header,
                const std::vector<results::Statistics>& statistics);

}  // namespace ridgeloc::studies
