#include "results/statistics/statistics.hpp"

#include <algorithm>
#include <stdexcept>

#include "results/statistics/extremes.hpp"

namespace ridgeloc::results {

MetricStatistics statistics_of(std::span<const double> values, InstructionSet set) {
  MetricStatistics statistics;
  statistics.moments = moments_of(values, set);
  const Extremes extremes = extremes_of(values, set);
  statistics.min = extremes.min;
  statistics.max = extremes.max;
  statistics.histogram.add(values, extremes, set);
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
