#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "results/statistics/histogram.hpp"
#include "results/statistics/moments.hpp"

namespace ridgeloc::results {

/// All that is kept of one metric over a set of trials.
struct MetricStatistics {
  Moments moments;           ///< over finite values up to `largest_moment_value`
  std::uint64_t beyond = 0;  ///< values above that, or infinite: in the quantiles, not in the moments
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
  Histogram histogram;  ///< all values but NaN

  friend bool operator==(const MetricStatistics&, const MetricStatistics&) = default;
};

MetricStatistics statistics_of(std::span<const double> values, InstructionSet set = best_instruction_set());
MetricStatistics merge(const MetricStatistics& a, const MetricStatistics& b);

/// What one method produced over a set of trials of one cell.
struct Statistics {
  std::uint64_t trials = 0;
  std::vector<std::uint64_t> events;      ///< count per `Schema::events`; empty: this method reports none
  std::vector<MetricStatistics> metrics;  ///< per `Schema::metrics`

  friend bool operator==(const Statistics&, const Statistics&) = default;
};

Statistics merge(const Statistics& a, const Statistics& b);

}  // namespace ridgeloc::results
