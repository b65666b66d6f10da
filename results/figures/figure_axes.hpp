#pragma once

#include <cstddef>
#include <vector>

#include "results/figures/figure_data.hpp"
#include "results/pictures/page.hpp"

namespace ridgeloc::results {

/// Whether a point has a place on an axis: finite, and positive on a logarithmic one. What was never seen has its upper
/// bound there.
bool is_drawable(const FigurePoint& point, bool log_y);

/// The horizontal axis: the limits asked for, else all ticks and a little beyond. Throws core::InputError for limits
/// that are not positive on a logarithmic axis.
AxisRange horizontal_range(const FigureData& data);

/// The vertical axis of a scale, that of all its panels: the limits asked for, else all marks, bars and bounds. Throws
/// core::InputError for limits that are not positive on a logarithmic axis.
AxisRange vertical_range(const FigureData& data, std::size_t scale);

/// Where a value stands on an axis, as a share of its length; outside of [0, 1] beyond its ends.
double share_of_axis(const AxisRange& range, bool logarithmic, double value);

/// The value at a share of the axis.
double value_on_axis(const AxisRange& range, bool logarithmic, double share);

/// A digit times a power of ten.
struct DecimalTick {
  double value = 0.0;
  int digit = 1;
  int power = 0;
};

/// 1 to 9 times the powers of ten that a logarithmic axis reaches, in order; none that a double cannot hold.
/// Precondition: the ends are positive and finite.
std::vector<DecimalTick> decimal_ticks(const AxisRange& range);

}  // namespace ridgeloc::results
