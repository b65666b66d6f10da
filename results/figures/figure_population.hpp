#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "results/figures/figure_data.hpp"

namespace ridgeloc::results {

/// Internal to figures: on how many trials the points or lines of a figure rest, in the words of its footnote.
class FigurePopulation {
 public:
  /// Notes a point or line of `values` values, of all trials that were run.
  void add(std::uint64_t values, std::uint64_t trials);

  std::string text_of_points() const;
  /// `share_outside`: the largest share of a line's values that lies outside of its axis.
  std::string text_of_lines(FigureStyle style, double share_outside) const;

 private:
  std::string count() const;

  std::uint64_t fewest_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t most_ = 0;
  double smallest_share_ = 1.0;  ///< of the trials that were run
};

}  // namespace ridgeloc::results
