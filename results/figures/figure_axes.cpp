#include "results/figures/figure_axes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "results/schema/text.hpp"

namespace ridgeloc::results {
namespace {

AxisRange linear_range(AxisRange range) {
  // Zero belongs to the axis where it is near: heights can then be compared as they look.
  if (range.low > 0.0 && range.low < 0.4 * range.high) range.low = 0.0;
  const double span = range.high - range.low;
  const double padding = span > 0.0 ? 0.06 * span : std::max(0.1 * std::abs(range.high), 1e-3);
  return {range.low == 0.0 ? 0.0 : range.low - padding, range.high + padding};
}

/// A range and a share of its length beyond both ends, in the logarithm, within what a double holds with all its
/// digits.
AxisRange beyond(const AxisRange& range, double share, double least_factor) {
  const double octaves = std::log2(range.high) - std::log2(range.low);
  const double factor = std::max(std::exp2(share * octaves), least_factor);
  return {std::max(range.low / factor, std::numeric_limits<double>::min()),
          std::min(range.high * factor, std::numeric_limits<double>::max())};
}

void check_limits(const AxisRange& range, bool logarithmic, const char* axis) {
  if (logarithmic && range.low <= 0.0) {
    throw core::InputError(fmt::format("--{}lim {}:{}: the axis is logarithmic; both ends have to be above 0", axis,
                                       range.low, range.high));
  }
}

}  // namespace

bool is_drawable(const FigurePoint& point, bool log_y) {
  // gnuplot has no logarithmic axis for numbers below the normal ones, 2e-308.
  const auto has_logarithm = [](double value) { return value >= std::numeric_limits<double>::min(); };
  return std::isfinite(point.y) && (!log_y || has_logarithm(point.never_seen ? point.hi : point.y));
}

AxisRange horizontal_range(const FigureData& data) {
  if (data.view.x) {
    check_limits(*data.view.x, data.log_x, "x");
    return *data.view.x;
  }
  const double first = data.x_ticks.front().position;
  const double last = data.x_ticks.back().position;
  if (data.is_categorical) return {first - 0.5, last + 0.5};
  constexpr double share = 0.04;
  if (data.log_x) return beyond({first, last}, share, last > first ? 1.0 : std::pow(10.0, share));
  const double padding = share * (last > first ? last - first : 1.0);
  return {first - padding, last + padding};
}

AxisRange vertical_range(const FigureData& data, std::size_t scale) {
  const bool log = data.scales[scale].log;
  if (data.view.y) {
    check_limits(*data.view.y, log, "y");
    return *data.view.y;
  }
  AxisRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const FigurePanel& panel : data.panels) {
    if (panel.scale != scale) continue;
    for (const FigureLine& line : panel.lines) {
      for (const FigurePoint& point : line.points) {
        if (!is_drawable(point, log)) continue;
        const double y = log && point.never_seen ? point.hi : point.y;
        // On a logarithmic axis a bar that reaches to zero would stretch the axis without end.
        const double lo = log ? std::max(point.lo, y / 3.0) : point.lo;
        range.low = std::min({range.low, y, std::isfinite(lo) ? lo : y});
        range.high = std::max({range.high, y, std::isfinite(point.hi) ? point.hi : y});
      }
    }
    for (const FigureBound& bound : panel.bounds) {
      for (const FigurePoint& point : bound.points) {
        if (!is_drawable(point, log)) continue;
        const bool has_band = bound.has_band && is_drawable({point.x, point.lo}, log);
        range.low = std::min(range.low, has_band ? point.lo : point.y);
        range.high = std::max(range.high, bound.has_band && std::isfinite(point.hi) ? point.hi : point.y);
      }
    }
  }
  if (range.low > range.high) return log ? AxisRange{0.1, 1.0} : AxisRange{};
  return log ? beyond(range, 0.06, 1.1) : linear_range(range);
}

double share_of_axis(const AxisRange& range, bool logarithmic, double value) {
  // Differences of logarithms hold where ratios overflow.
  if (logarithmic) return (std::log2(value) - std::log2(range.low)) / (std::log2(range.high) - std::log2(range.low));
  return (value - range.low) / (range.high - range.low);
}

double value_on_axis(const AxisRange& range, bool logarithmic, double share) {
  const double octaves = std::log2(range.high) - std::log2(range.low);
  if (logarithmic) return range.low * std::exp2(share * octaves);
  return range.low + share * (range.high - range.low);
}

std::vector<DecimalTick> decimal_ticks(const AxisRange& range) {
  std::vector<DecimalTick> ticks;
  const int last = static_cast<int>(std::floor(std::log10(range.high)));
  for (int power = static_cast<int>(std::floor(std::log10(range.low))); power <= last; ++power) {
    for (int digit = 1; digit < 10; ++digit) {
      const double value = decimal_number(digit, power);
      if (value > 0.0 && std::isfinite(value)) ticks.push_back({value, digit, power});
    }
  }
  return ticks;
}

}  // namespace ridgeloc::results
