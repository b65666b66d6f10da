#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "results/schema/schema.hpp"
#include "results/statistics/statistics.hpp"

namespace ridgeloc::results {

/// Stands where a quantity is not defined.
inline constexpr double undefined_value = std::numeric_limits<double>::quiet_NaN();

/// One metric or event of one method in one cell, with its error. Events, and metrics that are yes or no,
/// have unit "1" and their rate as mean.
struct SummaryRow {
  std::size_t cell = 0;
  std::size_t method = 0;
  std::string metric;
  std::string unit;
  std::uint64_t n = 0;       ///< size of the metric's population
  std::uint64_t beyond = 0;  ///< of these, infinite or above 10^6: in the quantiles, not in mean and sd
  double mean = 0.0;
  double mcse = 0.0;  ///< Monte Carlo standard error of the mean
  double lo = 0.0;    ///< 95 % interval of the mean (Wilson for a rate)
  double hi = 0.0;
  double sd = 0.0;
  double sd_mcse = 0.0;  ///< Monte Carlo standard error of sd, from the fourth moment
  double min = 0.0;
  double p05 = 0.0, p25 = 0.0, p50 = 0.0, p75 = 0.0, p95 = 0.0;
  double p50_lo = 0.0;  ///< 95 % interval of the median, from order statistics
  double p50_hi = 0.0;
  double max = 0.0;
  double rms = 0.0;  ///< root mean square: of errors the RMSE
  double rms_mcse = 0.0;
  double rms_lo = 0.0, rms_hi = 0.0;  ///< its 95 % interval
  double p95_lo = 0.0, p95_hi = 0.0;  ///< 95 % interval of p95, from order statistics
  bool trusted = false;               ///< whether the bar of the mean or rate is itself reliable
  bool rms_trusted = false;           ///< the same of the root mean square
};

/// A result in memory: what it is and, per cell and method (cell * methods + method), what came out.
struct Summary {
  Header header;
  std::vector<Statistics> statistics;
  bool is_sealed = true;  ///< false: a run has not come to its end, and this is what it has so far

  const Statistics& of(std::size_t cell, std::size_t method) const {
    return statistics[cell * header.methods.size() + method];
  }
};

/// How many values of a yes-or-no metric are 1.
std::uint64_t yes_count(const MetricStatistics& metric);

/// Rows in order of cell, method, metric (metrics first, then events). A metric or event for which a method
/// has no value in any cell is not reported by it and left out; where only this cell's population is empty,
/// the row stays with n = 0. Quantiles are held within [min, max]; of a metric with negative values they are
/// NaN, because its histogram does not resolve them, and of a result of format 1 they are NaN where they lie from 2^20
/// on.
///
/// Rows of ratios (`with_ratios`) have a ratio of means as mean.
///
/// A bar is trusted when it rests on at least 10 values (for a rate: 10 of either outcome), none of them beyond the
/// moments' limit, and not on a few of them: that of a mean when the variance of the variance, M4 / M2^2 - 1 / n, is at
/// most 0.1, that of a root mean square R when no value has more than a fifth of the sum of (v^2 - R^2)^2. Of
/// heavy-tailed metrics, whose samples do not show their tails before they are large, the limits are 0.02 and a
/// twentieth.
std::vector<SummaryRow> summary_rows(const Summary& summary);

/// The row of one metric or event of one method that is no ratio. Precondition: the schema has it.
SummaryRow summary_row(const Header& header, std::size_t method, const Statistics& statistics, std::string_view name);

}  // namespace ridgeloc::results
