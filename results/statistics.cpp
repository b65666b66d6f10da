#include "results/statistics.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace ridgeloc::results {
namespace {

struct Extremes {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
};

/// Smallest and largest value; NaN compares false and is passed over.
Extremes extremes_of(std::span<const double> values) {
  constexpr std::size_t lanes = 8;
  std::array<double, lanes> low;
  std::array<double, lanes> high;
  low.fill(Extremes{}.min);
  high.fill(Extremes{}.max);
  const auto visit = [&](double value, std::size_t lane) {
    low[lane] = value < low[lane] ? value : low[lane];
    high[lane] = value > high[lane] ? value : high[lane];
  };
  const std::size_t whole = values.size() / lanes * lanes;
  for (std::size_t i = 0; i < whole; i += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) visit(values[i + lane], lane);
  }
  for (std::size_t i = whole; i < values.size(); ++i) visit(values[i], i - whole);
  return {*std::min_element(low.begin(), low.end()), *std::max_element(high.begin(), high.end())};
}

}  // namespace

MetricStatistics statistics_of(std::span<const double> values) {
  MetricStatistics statistics;
  statistics.moments = moments_of(values);
  const Extremes extremes = extremes_of(values);
  statistics.min = extremes.min;
  statistics.max = extremes.max;
  statistics.histogram.add(values);
  statistics.beyond = statistics.histogram.total() - statistics.moments.n;
  return statistics;
}

MetricStatistics merge(const MetricStatistics& a, const MetricStatistics& b) {
  MetricStatistics c;
  c.moments = merge(a.moments, b.moments);
  c.beyond = a.beyond + b.beyond;
  c.min = std::min(a.min, b.min);
  c.max = std::max(a.max, b.max);
  c.histogram = a.histogram;
  c.histogram.merge(b.histogram);
  return c;
}

Statistics merge(const Statistics& a, const Statistics& b) {
  if (a == Statistics{}) return b;
  if (b == Statistics{}) return a;
  if (a.events.size() != b.events.size() || a.metrics.size() != b.metrics.size()) {
    throw std::invalid_argument("merge: the two statistics follow different schemas");
  }
  Statistics c;
  c.trials = a.trials + b.trials;
  c.events.reserve(a.events.size());
  for (std::size_t i = 0; i < a.events.size(); ++i) c.events.push_back(a.events[i] + b.events[i]);
  c.metrics.reserve(a.metrics.size());
  for (std::size_t i = 0; i < a.metrics.size(); ++i) c.metrics.push_back(merge(a.metrics[i], b.metrics[i]));
  return c;
}

}  // namespace ridgeloc::results
