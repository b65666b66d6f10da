#include "results/summary/ratio.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "results/statistics/interval.hpp"

namespace ridgeloc::results {
namespace {

double squared_error(const Moments& moments) {
  const double error = mean_standard_error(moments);
  return error * error;
}

/// The largest sum of squared deviations that all values but some can have.
double most_of_others(const MetricStatistics& metric, std::uint64_t some) {
  const double deviation = std::max(metric.max - metric.moments.mean, metric.moments.mean - metric.min);
  return static_cast<double>(metric.moments.n - some) * deviation * deviation;
}

}  // namespace

Estimate ratio_of_means(const Moments& a, const Moments& b, double covariance) {
  if (a.n < 2 || b.n < 2 || b.mean == 0.0) return {undefined_value, undefined_value, undefined_value, undefined_value};
  const double ratio = a.mean / b.mean;
  const double variance = squared_error(a) + ratio * ratio * squared_error(b) - 2.0 * ratio * covariance;
  // Zero in theory where a is a multiple of b; rounding may put it below.
  const double error = std::sqrt(std::max(variance, 0.0)) / std::abs(b.mean);
  const double half = student_quantile_975(std::min(a.n, b.n) - 1) * error;
  if (ratio <= 0.0) return {ratio, error, ratio - half, ratio + half};
  const double factor = std::exp(half / ratio);
  return {ratio, error, ratio / factor, ratio * factor};
}

double covariance_of_means(const MetricStatistics& a, const MetricStatistics& b, const MetricStatistics& difference) {
  const Moments& x = a.moments;
  const Moments& y = b.moments;
  const Moments& d = difference.moments;
  if (a.beyond > 0 || b.beyond > 0 || x.n < 2 || y.n < 2 || d.n > std::min(x.n, y.n)) return 0.0;
  const double shift = d.mean - (x.mean - y.mean);
  const double squares = d.m2 + static_cast<double>(d.n) * shift * shift;
  const double alone = most_of_others(a, d.n) + most_of_others(b, d.n);
  const double products = 0.5 * (x.m2 + y.m2 - squares - alone);
  const double n = static_cast<double>(x.n) * static_cast<double>(y.n);
  const double freedom = static_cast<double>(x.n - 1) * static_cast<double>(y.n - 1);
  const double covariance = products / std::sqrt(n * freedom);
  return alone > 0.0 ? std::max(covariance, 0.0) : covariance;
}

bool is_ratio_linear(const Moments& below) {
  constexpr double largest_relative_error = 0.1;
  return mean_standard_error(below) <= largest_relative_error * std::abs(below.mean);
}

Summary with_ratios(const Summary& summary) {
  Summary wider{summary.header, {}, summary.is_sealed};
  std::vector<MethodInfo>& methods = wider.header.methods;
  for (std::size_t m = 0; m < summary.header.methods.size(); ++m) {
    const MethodInfo& method = summary.header.methods[m];
    if (!method.difference) continue;
    const auto& [a, b] = *method.difference;
    const std::string label = methods[a].label + " / " + methods[b].label;
    methods.push_back({label, "", "ratio of the means of " + method.label, {}, m});
  }
  for (std::size_t cell = 0; cell < summary.header.cells.size(); ++cell) {
    for (std::size_t m = 0; m < methods.size(); ++m)
      wider.statistics.push_back(methods[m].ratio ? Statistics() : summary.of(cell, m));
  }
  return wider;
}

}  // namespace ridgeloc::results
