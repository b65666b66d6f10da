#include "results/summary/agreement.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "results/statistics/interval.hpp"

namespace ridgeloc::results {
namespace {

using Key = std::pair<std::string, std::string>;  ///< hashes of cell and method

double median_error(const SummaryRow& row) {
  return (row.p50_hi - row.p50_lo) / (2.0 * normal_quantile_975);
}

/// In units of the standard error; 0 where both are equal, whatever the error.
double scaled(double difference, double error) {
  return difference == 0.0 ? 0.0 : difference / error;
}

/// Nothing where no reliable error is known.
std::optional<NumberPair> compared(const SummaryRow& a, const SummaryRow& b, bool is_rate, bool is_heavy) {
  NumberPair pair{a.cell, a.method, a.metric, "mean", a.mean, b.mean, 0.0};
  if (a.n == 0 || b.n == 0) return std::nullopt;
  if (is_rate) {
    pair.statistic = "rate";
    const double n = static_cast<double>(a.n);
    const double m = static_cast<double>(b.n);
    const double pooled = (n * a.mean + m * b.mean) / (n + m);
    pair.standard_errors = scaled(a.mean - b.mean, std::sqrt(pooled * (1.0 - pooled) * (1.0 / n + 1.0 / m)));
  } else if (is_heavy && !std::isnan(a.p50)) {
    pair.statistic = "median";
    pair.first = a.p50;
    pair.second = b.p50;
    pair.standard_errors = scaled(a.p50 - b.p50, std::hypot(median_error(a), median_error(b)));
  } else if ((a.trusted && b.trusted) || a.mean == b.mean) {
    pair.standard_errors = scaled(a.mean - b.mean, std::hypot(a.mcse, b.mcse));
  } else {
    return std::nullopt;
  }
  if (!std::isfinite(pair.standard_errors)) return std::nullopt;
  return pair;
}

}  // namespace

Agreement agreement_of(const Summary& first, const Summary& second) {
  std::map<std::pair<Key, std::string>, SummaryRow> others;
  const auto key_of = [](const Header& header, const SummaryRow& row) {
    return std::pair(Key(header.cells[row.cell].hash, header.methods[row.method].hash), row.metric);
  };
  for (SummaryRow& row : summary_rows(second)) others.emplace(key_of(second.header, row), std::move(row));

  Agreement agreement;
  const auto& metrics = first.header.schema.metrics;
  for (const SummaryRow& row : summary_rows(first)) {
    const auto other = others.find(key_of(first.header, row));
    if (other == others.end()) continue;
    const auto metric = std::ranges::find(metrics, row.metric, &MetricInfo::name);
    const bool is_rate = metric == metrics.end() || metric->yes_no;
    if (const auto pair = compared(row, other->second, is_rate, !is_rate && metric->heavy_tailed)) {
      agreement.pairs.push_back(*pair);
    } else {
      ++agreement.untested;
    }
  }
  std::ranges::stable_sort(agreement.pairs, std::ranges::greater(),
                           [](const NumberPair& pair) { return std::fabs(pair.standard_errors); });
  if (agreement.pairs.empty()) return agreement;
  agreement.limit = two_sided_quantile(false_alarm_rate / static_cast<double>(agreement.pairs.size()));
  agreement.holds = std::fabs(agreement.pairs.front().standard_errors) <= agreement.limit;
  return agreement;
}

}  // namespace ridgeloc::results
