#pragma once

#include <vector>

#include "results/figures/figure_data.hpp"
#include "results/figures/figure_settings.hpp"

namespace ridgeloc::results {

/// Internal to figures: the horizontal axis of a curve, which is an axis of the sweep.
struct HorizontalAxis {
  /// Per value of the axis. Texts, and numbers among them, stand at 0, 1, 2, ..., those alone that are drawn.
  std::vector<double> positions;
  std::vector<FigureTick> ticks;  ///< of the values that are drawn, in order
  bool log = false;               ///< asked for, or positive numbers that span at least a factor of 100
  bool is_categorical = false;    ///< not all values are numbers
};

/// Throws core::InputError where a logarithmic axis is asked for and not all values are positive numbers.
HorizontalAxis horizontal_axis(const Header& header, const FigureSpec& spec, const FigureNames& names,
                               const FigureSettings& settings, bool log_x);

}  // namespace ridgeloc::results
