#include "studies/stop_rule.hpp"

#include <algorithm>
#include <cmath>

#include "results/interval.hpp"
#include "results/summary.hpp"

namespace ridgeloc::studies {

namespace {

const double growth = std::exp2(0.25);

std::uint64_t whole_blocks(std::uint64_t trials, std::uint64_t block_trials) {
  return (trials + block_trials - 1) / block_trials;
}

double standard_error(double low, double high) {
  return (high - low) / (2.0 * results::normal_quantile_975);
}

/// Whether one method's statistic is known well enough.
bool is_known(const StopRule& rule, const results::SummaryRow& row) {
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
  }
  const double target = rule.is_relative ? rule.target * std::fabs(value) : rule.target;
  return is_reliable && error <= target;  // not where the error is NaN
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

bool is_reached(const StopRule& rule, const results::Header& header,
                const std::vector<results::Statistics>& statistics) {
  for (std::size_t m = 0; m < header.methods.size(); ++m) {
    const bool is_named = std::ranges::find(rule.methods, header.methods[m].label) != rule.methods.end();
    if (rule.methods.empty() ? header.methods[m].difference.has_value() : !is_named) continue;
    const results::SummaryRow row = results::summary_row(header, m, statistics[m], rule.metric);
    if (row.n == 0 && !is_named) continue;
    if (!is_known(rule, row)) return false;
  }
  return true;
}

}  // namespace ridgeloc::studies
