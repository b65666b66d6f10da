#include "results/figures/figure_population.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ridgeloc::results {

void FigurePopulation::add(std::uint64_t values, std::uint64_t trials) {
  fewest_ = std::min(fewest_, values);
  most_ = std::max(most_, values);
  if (trials > 0)
    smallest_share_ = std::min(smallest_share_, static_cast<double>(values) / static_cast<double>(trials));
}

std::string FigurePopulation::count() const {
  return fewest_ >= most_ ? fmt::format("{}", most_) : fmt::format("{} to {}", fewest_, most_);
}

std::string FigurePopulation::text_of_points() const {
  const std::string share =
      smallest_share_ < 1.0 ? fmt::format(" ({:.2g} % or more of those that were run)", 100.0 * smallest_share_) : "";
  return fmt::format("{} trials per point{}; bars: 95 % intervals; points share trials and are not independent",
                     count(), share);
}

std::string FigurePopulation::text_of_lines(FigureStyle style, double share_outside) const {
  std::string text = count() + " values per line";
  if (style == FigureStyle::Bands) text += "; bands: 95 % intervals at each place";
  if (share_outside > 0.0)
    text += fmt::format("; outside of the axis: at most {:.2g} % of a line", 100.0 * share_outside);
  return text + "; lines share trials and are not independent";
}

}  // namespace ridgeloc::results
