#pragma once

#include <cstddef>
#include <optional>

#include "results/pictures/page.hpp"

namespace ridgeloc::results {

/// How a figure is looked at, beside what the study says of it. What is not set follows from the data.
struct FigureView {
  std::optional<AxisRange> x = {};  ///< ends of the horizontal axis
  std::optional<AxisRange> y = {};  ///< ends of the vertical axes
  bool log_x = false;               ///< a logarithmic horizontal axis, also where it spans no decades
  std::optional<Page> size = {};
  std::size_t columns = 0;  ///< of panels; 0: one for each scale
};

}  // namespace ridgeloc::results
