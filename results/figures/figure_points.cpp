#include "results/figures/figure_points.hpp"

#include <algorithm>
#include <limits>

#include "results/statistics/interval.hpp"

namespace ridgeloc::results {

namespace {

using Statistic = FigureNames::Statistic;

/// Of a median; that of a mean stands in its row.
constexpr std::uint64_t fewest_for_median = 10;

/// Of any other quantile, on its rarer side.
constexpr double fewest_beyond_quantile = 5.0;

/// The quantile of a row with its interval; NaN of what has negative values, as in the row.
FigurePoint quantile_point(const SummaryRow& row, const Histogram& histogram, unsigned percent, double x) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (row.n == 0 || row.min < 0.0) return {x, nan, nan, nan};
  const double q = percent / 100.0;
  const Interval interval = quantile_interval(histogram, q);
  const auto within = [&](double value) { return std::clamp(value, row.min, row.max); };
  const double rarer = std::min(q, 1.0 - q) * static_cast<double>(row.n);
  return {x, within(histogram.quantile(q)), within(interval.lo), within(interval.hi), rarer >= fewest_beyond_quantile};
}

FigurePoint rate_point(const SummaryRow& row, double x) {
  FigurePoint point{x, row.mean, row.lo, row.hi, row.trusted};
  if (row.n > 0 && row.mean == 0.0) {
    point.never_seen = true;
    point.hi = upper_bound_of_none(row.n);
  }
  return point;
}

}  // namespace

FigurePoint figure_point(const SummaryRow& row, const Histogram& histogram, const FigureNames::Quantity& quantity,
                         double x) {
  switch (quantity.statistic) {
    case Statistic::Median:
      return {x, row.p50, row.p50_lo, row.p50_hi, row.n >= fewest_for_median};
    case Statistic::Quantile:
      return quantile_point(row, histogram, quantity.percent, x);
    case Statistic::RootMeanSquare:
      return {x, row.rms, row.rms_lo, row.rms_hi, row.rms_trusted};
    case Statistic::Rate:
      return rate_point(row, x);
    case Statistic::Mean:
    case Statistic::RatioOfMeans:
      break;
  }
  return {x, row.mean, row.lo, row.hi, row.trusted};
}

}  // namespace ridgeloc::results
