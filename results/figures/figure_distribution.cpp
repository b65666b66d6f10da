#include "results/figures/figure_distribution.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "results/schema/text.hpp"
#include "results/statistics/interval.hpp"

namespace ridgeloc::results {
namespace {

constexpr double low_quantile = 0.001;
constexpr double high_quantile = 0.999;

/// Whether the values of a bin are above zero and finite.
bool is_inner(std::uint32_t bin) {
  return bin > 0 && bin < Histogram::infinite_bin;
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
};

/// From the low to the high quantile; where these are zero or infinite, from the first to the last value that is not.
Range range_of(const Histogram& histogram) {
  Range range;
  for (const auto& [bin, count] : histogram.bins()) {
    if (!is_inner(bin)) continue;
    range.low = std::min(range.low, Histogram::lower_edge(bin));
    range.high = Histogram::lower_edge(bin + 1);
  }
  if (range.high == 0.0) return range;
  const double high = histogram.quantile(high_quantile);
  return {std::max(range.low, histogram.quantile(low_quantile)),
          high > range.low ? std::min(range.high, high) : range.high};
}

/// 1, 2 and 5 times the powers of ten, from the last one up to `low` to the first one from `high` on.
std::vector<double> preferred_numbers(double low, double high) {
  std::vector<double> numbers;
  const int first = static_cast<int>(std::floor(std::log10(low)));
  for (int power = first; numbers.empty() || numbers.back() < high; ++power) {
    for (const int digit : {1, 2, 5}) {
      const double value = decimal_number(digit, power);
      if (value <= low) numbers.clear();
      if (numbers.empty() || numbers.back() < high) numbers.push_back(value);
    }
  }
  return numbers;
}

/// Rice's rule for the number of bins, 2 n^(1/3), rounded to bins that join whole bins of the histogram.
std::uint32_t bins_to_join(double low, double high, std::uint64_t values) {
  const double fine = std::log2(high / low) * Histogram::bins_per_octave;
  const double wanted = 2.0 * std::cbrt(static_cast<double>(values));
  std::uint32_t joined = 1;
  while (joined < Histogram::bins_per_octave && fine / joined > wanted) joined *= 2;
  return joined;
}

/// The whole numbers of a bin: from the first to before the end.
struct WholeNumbers {
  double first = 0.0;
  double end = 0.0;
};
WholeNumbers whole_numbers_in(std::uint32_t bin) {
  return {std::ceil(Histogram::lower_edge(bin)), std::ceil(Histogram::lower_edge(bin + 1))};
}

}  // namespace

FigureDistribution::FigureDistribution(Kind kind, bool whole_numbers, const std::vector<const Histogram*>& histograms)
    : kind_(kind), whole_numbers_(whole_numbers) {
  Range range;
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max();
  for (const Histogram* histogram : histograms) {
    const Range own = range_of(*histogram);
    range = {std::min(range.low, own.low), std::max(range.high, own.high)};
    fewest = std::min(fewest, histogram->total());
  }
  if (range.high == 0.0) range = {0.1, 1.0};  // nothing but zeros and infinite values
  // The outline of a number begins half a unit before it.
  if (whole_numbers_ && kind_ == Kind::Histogram) range.low -= 0.5;
  const std::vector<double> numbers = preferred_numbers(range.low, range.high);
  low_ = numbers.front();
  high_ = numbers.back();
  joined_ = bins_to_join(range.low, range.high, fewest);
}

std::vector<FigureTick> FigureDistribution::ticks() const {
  constexpr double longest_with_all_labels = 300.0;
  const bool is_long = high_ / low_ > longest_with_all_labels;
  std::vector<FigureTick> ticks;
  for (const double number : preferred_numbers(low_, high_)) {
    const std::string text = fmt::format("{:g}", number);
    const bool is_power = std::abs(std::remainder(std::log10(number), 1.0)) < 1e-9;
    ticks.push_back({number, is_long && !is_power ? "" : text});
  }
  return ticks;
}

std::string FigureDistribution::y_label() const {
  if (kind_ == Kind::Ecdf) return "cumulative share of the values";
  return whole_numbers_ ? "share of the values per whole number" : "share of the values per factor of 2";
}

std::vector<FigurePoint> FigureDistribution::points(const Histogram& histogram) const {
  return kind_ == Kind::Ecdf ? cumulative(histogram) : density(histogram);
}

std::vector<FigurePoint> FigureDistribution::cumulative(const Histogram& histogram) const {
  const std::uint64_t total = histogram.total();
  std::vector<FigurePoint> points;
  const auto add = [&](double x, std::uint64_t below) {
    const Interval interval = wilson_interval(below, total);
    points.push_back({x, static_cast<double>(below) / static_cast<double>(total), interval.lo, interval.hi});
  };
  std::uint64_t below = 0;
  for (const auto& [bin, count] : histogram.bins()) {
    if (Histogram::lower_edge(bin) >= high_) break;
    const WholeNumbers whole = whole_numbers_in(bin);
    const double left = whole_numbers_ ? whole.first : Histogram::lower_edge(bin);
    const double right = whole_numbers_ ? std::max(whole.first, whole.end - 1.0) : Histogram::lower_edge(bin + 1);
    if (is_inner(bin) && left >= low_ && right <= high_) {
      if (points.empty()) add(low_, below);
      if (points.back().x < left || whole_numbers_) add(left, below);
      add(right, below + count);
    }
    below += count;
  }
  if (!points.empty()) add(high_, below);
  return points;
}

std::vector<FigurePoint> FigureDistribution::density(const Histogram& histogram) const {
  const double total = static_cast<double>(histogram.total());
  std::vector<FigurePoint> points;
  const auto add = [&](double x, double y) { points.push_back({x, y, y, y}); };
  const std::uint32_t step = whole_numbers_ ? 1 : joined_;
  // Octaves begin at multiples of the number of their bins, which `step` divides.
  for (std::uint32_t bin = Histogram::bin_of(low_) / step * step; bin < Histogram::infinite_bin; bin += step) {
    const WholeNumbers whole = whole_numbers_in(bin);
    if (whole_numbers_ && whole.first == whole.end) continue;
    const double left = whole_numbers_ ? whole.first - 0.5 : Histogram::lower_edge(bin);
    const double right = whole_numbers_ ? whole.end - 0.5 : Histogram::lower_edge(bin + step);
    if (right <= low_) continue;
    if (left >= high_) break;
    std::uint64_t count = 0;
    for (std::uint32_t i = 0; i < step; ++i) count += histogram.count_in(bin + i);
    const double width = whole_numbers_ ? right - left : std::log2(right / left);
    const double height = static_cast<double>(count) / total / width;
    add(std::max(left, low_), height);
    add(std::min(right, high_), height);
  }
  return points;
}

double FigureDistribution::share_outside(const Histogram& histogram) const {
  std::uint64_t inside = 0;
  for (const auto& [bin, count] : histogram.bins()) {
    if (is_inner(bin) && Histogram::lower_edge(bin + 1) > low_ && Histogram::lower_edge(bin) < high_) inside += count;
  }
  return 1.0 - static_cast<double>(inside) / static_cast<double>(histogram.total());
}

}  // namespace ridgeloc::results
