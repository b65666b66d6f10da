#pragma once

#include "results/figures/figure_data.hpp"
#include "results/figures/figure_names.hpp"
#include "results/statistics/histogram.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// The statistic of a row that a figure draws at x, with its 95 % interval. `trusted` says whether the interval is; a
/// rate of what was never seen has its upper bound for `hi`. NaN where the row has no such statistic. The histogram is
/// that of the row, and matters to quantiles alone.
FigurePoint figure_point(const SummaryRow& row, const Histogram& histogram, const FigureNames::Quantity& quantity,
                         double x);

}  // namespace ridgeloc::results
