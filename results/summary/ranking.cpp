#include "results/summary/ranking.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "results/statistics/interval.hpp"

namespace ridgeloc::results {
namespace {

/// A result that has been read knows what is compared by the differences that it holds.
bool is_compared(const Summary& summary, std::size_t metric) {
  if (summary.header.schema.metrics[metric].is_compared) return true;
  for (std::size_t m = 0; m < summary.header.methods.size(); ++m) {
    if (!summary.header.methods[m].difference) continue;
    for (std::size_t cell = 0; cell < summary.header.cells.size(); ++cell) {
      const auto& metrics = summary.of(cell, m).metrics;
      if (metric < metrics.size() && metrics[metric].moments.n + metrics[metric].beyond > 0) return true;
    }
  }
  return false;
}

bool all_trials_have(const Summary& summary, const Measure& measure) {
  bool any = false;
  for (std::size_t cell = 0; cell < summary.header.cells.size(); ++cell) {
    for (std::size_t m = 0; m < summary.header.methods.size(); ++m) {
      const Statistics& statistics = summary.of(cell, m);
      if (summary.header.methods[m].difference || statistics.events.empty()) continue;
      any = true;
      if (summary_row(summary.header, m, statistics, measure.name).n != statistics.trials) return false;
    }
  }
  return any;
}

double leading_number(const SummaryRow& row, const Measure& measure) {
  return measure.lead == Measure::Lead::Median ? row.p50 : row.mean;
}

/// Whether the median of `a` is below that of `b` by more than z times what the standard error of their difference is
/// at most, the sum of those that their intervals stand for. Fewer trials say little of intervals wider than these.
/// An infinite median, of a method that mostly fails, is larger if its interval is infinite as a whole.
bool has_smaller_median(const SummaryRow& a, const SummaryRow& b, double z) {
  constexpr std::uint64_t fewest_trials = 100;
  if (std::min(a.n, b.n) < fewest_trials) return false;
  if (std::isinf(b.p50_lo)) return std::isfinite(a.p50_hi);
  const double unit = two_sided_quantile(0.05);
  const double error = (a.p50_hi - a.p50) / unit + (b.p50 - b.p50_lo) / unit;
  return b.p50 - a.p50 > z * error;
}

/// A difference of two means and what its standard error is at most.
struct Difference {
  double mean = 0.0;
  double error = std::numeric_limits<double>::infinity();
  std::uint64_t n = 0;
};

class CellRanking {
 public:
  CellRanking(const Summary& summary, std::size_t cell, const Measure& measure)
      : summary_(summary), cell_(cell), measure_(measure) {}

  SummaryRow row(std::size_t method) const {
    return summary_row(summary_.header, method, summary_.of(cell_, method), measure_.name);
  }

  /// The mean of a less that of b; with an infinite error where it is not reliable.
  Difference difference(std::size_t a, std::size_t b) const {
    if (const auto compared = paired(a, b)) return *compared;
    Difference best;
    const SummaryRow of_a = row(a);
    const SummaryRow of_b = row(b);
    if (of_a.trusted && of_b.trusted) best = {of_a.mean - of_b.mean, of_a.mcse + of_b.mcse, std::min(of_a.n, of_b.n)};
    for (std::size_t c = 0; c < summary_.header.methods.size(); ++c) {
      const auto first = paired(a, c);
      const auto second = paired(b, c);
      // Over other trials each difference would mean another.
      if (!first || !second || first->n != second->n) continue;
      if (const double error = first->error + second->error; error < best.error)
        best = {first->mean - second->mean, error, first->n};
    }
    return best;
  }

 private:
  /// From the trials that both have; none where the two are not compared.
  std::optional<Difference> paired(std::size_t a, std::size_t b) const {
    const auto& methods = summary_.header.methods;
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const bool forward = methods[m].difference == std::array{a, b};
      if (!forward && methods[m].difference != std::array{b, a}) continue;
      const SummaryRow found = row(m);
      Difference difference{forward ? found.mean : -found.mean};
      difference.n = found.n;
      if (found.trusted) difference.error = found.mcse;
      return difference;
    }
    return std::nullopt;
  }

  const Summary& summary_;
  std::size_t cell_;
  const Measure& measure_;
};

}  // namespace

std::vector<Measure> ranking_measures(const Summary& summary) {
  const std::vector<MetricInfo>& metrics = summary.header.schema.metrics;
  const std::vector<Measure> measures = measures_of(summary.header.schema);
  std::vector<Measure> ranking;
  for (std::size_t m = 0; m < metrics.size(); ++m) {
    if (metrics[m].yes_no || !is_compared(summary, m)) continue;
    if (ranking.empty() || ranking.front().unit == metrics[m].unit) ranking.push_back(measures[m]);
  }
  return ranking;
}

std::optional<Measure> ranking_measure(const Summary& summary) {
  const std::vector<Measure> measures = ranking_measures(summary);
  const auto whole = std::ranges::find_if(measures, [&](const Measure& m) { return all_trials_have(summary, m); });
  if (whole != measures.end()) return *whole;
  return measures.empty() ? std::nullopt : std::optional(measures.front());
}

std::optional<Ranking> ranking_of(const Summary& summary, std::size_t cell, const std::vector<std::size_t>& methods,
                                  const Measure& measure) {
  const CellRanking ranking(summary, cell, measure);
  std::vector<std::size_t> candidates;
  std::vector<double> numbers;
  for (const std::size_t method : methods) {
    const double number = leading_number(ranking.row(method), measure);
    if (summary.header.methods[method].difference || std::isnan(number)) continue;
    candidates.push_back(method);
    numbers.push_back(number);
  }
  if (candidates.size() < 2) return std::nullopt;
  const auto best = std::ranges::min_element(numbers) - numbers.begin();
  Ranking result{candidates[static_cast<std::size_t>(best)], {}};
  const bool by_medians = measure.lead == Measure::Lead::Median;
  const double looks = static_cast<double>(candidates.size() - 1) * (by_medians ? 2.0 : 1.0);
  const double z = two_sided_quantile(0.05 / looks);
  for (const std::size_t other : candidates) {
    if (other == result.best) continue;
    const Difference difference = ranking.difference(result.best, other);
    const double t = difference.n < 2 ? 0.0 : student_quantile(z, difference.n - 1);
    const bool has_larger_mean = difference.n >= 2 && difference.mean + t * difference.error < 0.0;
    const bool has_larger_median = by_medians && has_smaller_median(ranking.row(result.best), ranking.row(other), z);
    if (!has_larger_mean && !has_larger_median) result.rivals.push_back(other);
  }
  return result;
}

}  // namespace ridgeloc::results
