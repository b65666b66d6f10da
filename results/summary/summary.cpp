#include "results/summary/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "results/statistics/interval.hpp"
#include "results/summary/ratio.hpp"

namespace ridgeloc::results {
namespace {

/// Below this a standard error is too uncertain, and Wilson's interval of a rare event too lopsided, to be a
/// bar.
constexpr std::uint64_t fewest_trusted = 10;

/// How much of an error may rest on few values.
struct TrustLimits {
  double variance_of_variance;
  double share_of_squares;
};
constexpr TrustLimits light_tails = {0.1, 0.2};  // standard errors of means within 16 % (MCNP's rule)
constexpr TrustLimits heavy_tails = {0.02, 0.05};

const TrustLimits& limits_of(const MetricInfo& info) {
  return info.heavy_tailed ? heavy_tails : light_tails;
}

SummaryRow blank_row(std::size_t cell, std::size_t method, std::string metric, std::string unit) {
  SummaryRow row;
  row.cell = cell;
  row.method = method;
  row.metric = std::move(metric);
  row.unit = std::move(unit);
  for (double* field : {&row.mean, &row.mcse, &row.lo,       &row.hi,     &row.sd,     &row.sd_mcse, &row.min,
                        &row.p05,  &row.p25,  &row.p50,      &row.p75,    &row.p95,    &row.p50_lo,  &row.p50_hi,
                        &row.max,  &row.rms,  &row.rms_mcse, &row.rms_lo, &row.rms_hi, &row.p95_lo,  &row.p95_hi}) {
    *field = undefined_value;
  }
  return row;
}

/// Of a sample without spread, or with that of rounding alone, nothing is known of how it would spread, as of a rate
/// without events.
bool has_enough(const MetricStatistics& metric) {
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  return metric.moments.n >= fewest_trusted && metric.beyond == 0 &&
         standard_deviation(metric.moments) > rounding * std::fabs(metric.moments.mean);
}

bool is_mean_trusted(const MetricInfo& info, const MetricStatistics& metric) {
  return has_enough(metric) && variance_of_variance(metric.moments) <= limits_of(info).variance_of_variance;
}

bool is_rms_trusted(const MetricInfo& info, const MetricStatistics& metric) {
  return has_enough(metric) &&
         largest_share_of_squares(metric.moments, metric.min, metric.max) <= limits_of(info).share_of_squares;
}

void fill_moments(SummaryRow& row, const MetricInfo& info, const MetricStatistics& metric) {
  const Moments& moments = metric.moments;
  if (moments.n == 0) return;
  row.mean = moments.mean;
  row.mcse = mean_standard_error(moments);
  row.sd = standard_deviation(moments);
  row.sd_mcse = standard_deviation_error(moments);
  const Interval interval = mean_interval(moments);
  row.lo = interval.lo;
  row.hi = interval.hi;
  row.rms = root_mean_square(moments);
  row.rms_mcse = root_mean_square_error(moments);
  const Interval rms = root_mean_square_interval(moments);
  row.rms_lo = rms.lo;
  row.rms_hi = rms.hi;
  row.trusted = is_mean_trusted(info, metric);
  row.rms_trusted = is_rms_trusted(info, metric);
}

void fill_quantiles(SummaryRow& row, const MetricInfo& info, const MetricStatistics& metric) {
  if (row.n == 0) return;
  row.min = metric.min;
  row.max = metric.max;
  if (metric.min < 0.0) return;
  // Within a bin a quantile is interpolated; of counts only the whole number in the bin can be meant.
  const auto within = [&](double value) {
    // Results before version 2.0 do not tell finite values from 2^20 on from infinite ones.
    if (std::isinf(value) && std::isfinite(metric.max)) return undefined_value;
    // The upper edge of a bin is not in it: at a full share the largest whole number below is meant.
    const double whole = std::floor(std::nextafter(value, 0.0));
    return std::clamp(info.whole_numbers ? whole : value, metric.min, metric.max);
  };
  // A whole number is meant wherever in its bin a quantile falls.
  const auto range = info.whole_numbers ? Histogram::Range() : Histogram::Range{metric.min, metric.max};
  const auto quantile = [&](double q) { return within(metric.histogram.quantile(q, range)); };
  row.p05 = quantile(0.05);
  row.p25 = quantile(0.25);
  row.p50 = quantile(0.50);
  row.p75 = quantile(0.75);
  row.p95 = quantile(0.95);
  const Interval median = quantile_interval(metric.histogram, 0.5, range);
  row.p50_lo = within(median.lo);
  row.p50_hi = within(median.hi);
  const Interval p95 = quantile_interval(metric.histogram, 0.95, range);
  row.p95_lo = within(p95.lo);
  row.p95_hi = within(p95.hi);
}

void fill_rate(SummaryRow& row, std::uint64_t count) {
  if (row.n == 0) return;
  const double n = static_cast<double>(row.n);
  row.mean = static_cast<double>(count) / n;
  row.mcse = std::sqrt(row.mean * (1.0 - row.mean) / n);
  const Interval interval = wilson_interval(count, row.n);
  row.lo = interval.lo;
  row.hi = interval.hi;
  row.trusted = std::min(count, row.n - count) >= fewest_trusted;
}

SummaryRow metric_row(std::size_t cell, std::size_t method, const MetricInfo& info, const MetricStatistics& metric) {
  SummaryRow row = blank_row(cell, method, info.name, info.unit);
  row.n = metric.moments.n + metric.beyond;
  if (info.yes_no) {
    fill_rate(row, yes_count(metric));
    return row;
  }
  row.beyond = metric.beyond;
  fill_moments(row, info, metric);
  fill_quantiles(row, info, metric);
  return row;
}

SummaryRow event_row(std::size_t cell, std::size_t method, const EventInfo& info, std::uint64_t count,
                     std::uint64_t trials) {
  SummaryRow row = blank_row(cell, method, info.name, "1");
  row.n = trials;
  fill_rate(row, count);
  return row;
}

/// The ratio of the means of the two methods of a difference.
SummaryRow ratio_row(const Summary& summary, std::size_t cell, std::size_t method, std::size_t metric) {
  const auto statistics_of_method = [&](std::size_t m) -> MetricStatistics {
    const auto& metrics = summary.of(cell, m).metrics;
    return metric < metrics.size() ? metrics[metric] : MetricStatistics();
  };
  const std::size_t difference = *summary.header.methods[method].ratio;
  const MetricStatistics above = statistics_of_method((*summary.header.methods[difference].difference)[0]);
  const MetricStatistics below = statistics_of_method((*summary.header.methods[difference].difference)[1]);
  const MetricInfo& info = summary.header.schema.metrics[metric];
  SummaryRow row = blank_row(cell, method, info.name, "1");
  row.n = std::min(above.moments.n, below.moments.n);
  if (row.n == 0) return row;
  const Moments& a = above.moments;
  const Moments& b = below.moments;
  const Estimate ratio = ratio_of_means(a, b, covariance_of_means(above, below, statistics_of_method(difference)));
  row.mean = ratio.value;
  row.mcse = ratio.error;
  row.lo = ratio.lo;
  row.hi = ratio.hi;
  row.trusted = is_mean_trusted(info, above) && is_mean_trusted(info, below) && is_ratio_linear(b);
  return row;
}

/// What a method reports anywhere: a flag per metric, and whether it has events.
struct Reported {
  std::vector<bool> metrics;
  bool events = false;
};

Reported reported_by(const Summary& summary, std::size_t method) {
  Reported reported{std::vector<bool>(summary.header.schema.metrics.size(), false)};
  for (std::size_t cell = 0; cell < summary.header.cells.size(); ++cell) {
    const Statistics& statistics = summary.of(cell, method);
    reported.events = reported.events || !statistics.events.empty();
    for (std::size_t i = 0; i < statistics.metrics.size(); ++i) {
      const MetricStatistics& metric = statistics.metrics[i];
      if (metric.moments.n + metric.beyond > 0) reported.metrics[i] = true;
    }
  }
  return reported;
}

}  // namespace

std::uint64_t yes_count(const MetricStatistics& metric) {
  return static_cast<std::uint64_t>(std::llround(metric.moments.mean * static_cast<double>(metric.moments.n)));
}

std::vector<SummaryRow> summary_rows(const Summary& summary) {
  const Schema& schema = summary.header.schema;
  const std::size_t methods = summary.header.methods.size();
  std::vector<Reported> reported;
  for (std::size_t method = 0; method < methods; ++method)
    reported.push_back(reported_by(summary, summary.header.methods[method].ratio.value_or(method)));

  // Stands for a cell that has not been computed yet.
  const MetricStatistics no_metric;
  std::vector<SummaryRow> rows;
  for (std::size_t cell = 0; cell < summary.header.cells.size(); ++cell) {
    for (std::size_t method = 0; method < methods; ++method) {
      const Statistics& statistics = summary.of(cell, method);
      for (std::size_t i = 0; i < schema.metrics.size(); ++i) {
        if (!reported[method].metrics[i]) continue;
        if (summary.header.methods[method].ratio) {
          rows.push_back(ratio_row(summary, cell, method, i));
          continue;
        }
        const bool present = i < statistics.metrics.size();
        rows.push_back(metric_row(cell, method, schema.metrics[i], present ? statistics.metrics[i] : no_metric));
      }
      if (!reported[method].events) continue;
      for (std::size_t i = 0; i < schema.events.size(); ++i) {
        const bool present = i < statistics.events.size();
        rows.push_back(event_row(cell, method, schema.events[i], present ? statistics.events[i] : 0,
                                 present ? statistics.trials : 0));
      }
    }
  }
  return rows;
}

SummaryRow summary_row(const Header& header, std::size_t method, const Statistics& statistics, std::string_view name) {
  const Schema& schema = header.schema;
  for (std::size_t i = 0; i < schema.metrics.size(); ++i) {
    if (schema.metrics[i].name != name) continue;
    return metric_row(0, method, schema.metrics[i],
                      i < statistics.metrics.size() ? statistics.metrics[i] : MetricStatistics());
  }
  const auto event = std::ranges::find(schema.events, name, &EventInfo::name);
  const auto index = static_cast<std::size_t>(event - schema.events.begin());
  if (index < statistics.events.size())
    return event_row(0, method, *event, statistics.events[index], statistics.trials);
  return blank_row(0, method, event->name, "1");
}

}  // namespace ridgeloc::results
