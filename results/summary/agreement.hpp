#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// A number of two results, side by side.
struct NumberPair {
  std::size_t cell = 0;    ///< of the first result
  std::size_t method = 0;  ///< of the first result
  std::string metric;
  const char* statistic = "";  ///< "mean", "median" or "rate"
  double first = 0.0;
  double second = 0.0;
  double standard_errors = 0.0;  ///< their difference over its standard error, if the trials are independent
};

/// Two results of the same study compared, number by number.
struct Agreement {
  std::vector<NumberPair> pairs;  ///< the largest difference first
  std::size_t untested = 0;       ///< numbers whose error is not known or not reliable in either
  double limit = 0.0;             ///< in standard errors
  bool holds = true;              ///< no difference is beyond the limit
};

/// Chance that two results that differ by nothing but chance are said to disagree.
inline constexpr double false_alarm_rate = 1e-3;

/// Compares the leading statistic of every metric, and every rate, of the cells and methods that both have (by hash).
/// The limit is the normal quantile at which the largest of all differences has the chance `false_alarm_rate`
/// (Bonferroni). With shared trials the real chance is smaller: the errors are then those of independent trials, and
/// too large.
Agreement agreement_of(const Summary& first, const Summary& second);

}  // namespace ridgeloc::results
