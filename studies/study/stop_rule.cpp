#include "studies/study/stop_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "results/statistics/interval.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::studies {

namespace {

const double growth = std::exp2(0.25);

std::uint64_t whole_blocks(std::uint64_t trials, std::uint64_t block_trials) {
  return (trials + block_trials - 1) / block_trials;
}

double standard_error(double low, double high) {
  return (high - low) / (2.0 * results::normal_quantile_975);
}

/// Of one method.
Precision precision_of(const StopRule& rule, const results::SummaryRow& row) {
  const bool is_rate = std::isnan(row.min);
  double value = row.mean;
  double error = is_rate ? standard_error(row.lo, row.hi) : row.mcse;
  bool is_reliable = is_rate || row.trusted || row.sd == 0.0;
  if (!is_rate && rule.statistic == "median") {
    value = row.p50;
    error = standard_error(row.p50_lo, row.p50_hi);
    is_reliable = true;
  } else if (!is_rate && rule.statistic == "rms") {
    value = row.rms;
    error = row.rms_mcse;
    is_reliable = row.rms_trusted || row.sd == 0.0;
  }
  if (error == 0.0) return {0.0, is_reliable};
  return {error / (rule.is_relative ? rule.target * std::fabs(value) : rule.target), is_reliable};
}

}  // namespace

std::vector<std::uint64_t> looks(const StopRule& rule, std::uint64_t block_trials) {
  const std::uint64_t last = whole_blocks(rule.max_trials, block_trials);
  std::vector<std::uint64_t> blocks = {std::min(whole_blocks(rule.min_trials, block_trials), last)};
  while (blocks.back() < last) {
    const auto grown = static_cast<std::uint64_t>(std::ceil(static_cast<double>(blocks.back()) * growth));
    blocks.push_back(std::min(std::max(grown, blocks.back() + 1), last));
  }
  return blocks;
}

Precision precision_of(const StopRule& rule, const results::Header& header,
                       const std::vector<results::Statistics>& statistics) {
  Precision worst;
  for (std::size_t m = 0; m < header.methods.size(); ++m) {
    const bool is_named = std::ranges::find(rule.methods, header.methods[m].label) != rule.methods.end();
    if (rule.methods.empty() ? header.methods[m].difference.has_value() : !is_named) continue;
    const results::SummaryRow row = results::summary_row(header, m, statistics[m], rule.metric);
    if (row.n == 0 && !is_named) continue;
    const Precision precision = precision_of(rule, row);
    worst.is_reliable = worst.is_reliable && precision.is_reliable;
    // Once NaN, always NaN.
    if (!(precision.error_over_target <= worst.error_over_target))
      worst.error_over_target =
          std::isnan(worst.error_over_target) ? worst.error_over_target : precision.error_over_target;
  }
  return worst;
}

double priority(const Precision& precision, double cost) {
  if (!std::isfinite(precision.error_over_target)) return std::numeric_limits<double>::infinity();
  const double ratio = precision.is_reliable ? precision.error_over_target : std::max(precision.error_over_target, 1.0);
  return ratio * ratio / cost;
}

std::uint64_t predicted_trials(const StopRule& rule, const Precision& precision, std::uint64_t trials,
                               std::uint64_t block_trials) {
  const std::vector<std::uint64_t> blocks = looks(rule, block_trials);
  const double needed = static_cast<double>(trials) * precision.error_over_target * precision.error_over_target;
  const auto enough =
      std::ranges::find_if(blocks, [&](std::uint64_t b) { return static_cast<double>(b * block_trials) >= needed; });
  return std::min((enough == blocks.end() ? blocks.back() : *enough) * block_trials, rule.max_trials);
}

}  // namespace ridgeloc::studies
