#pragma once
// Internal to results: the group /summary, which xarray opens with named axes.

#include "results/hdf5/hdf5.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// Writes for each metric and event an array over (axes..., method, statistic), with a dimension scale per dimension.
/// Where the cells do not fill the grid that the axes span, as in zipped sweeps, the array is over (cell, method,
/// statistic) instead, and the axes are coordinates along "cell", which the attribute `coordinates` names as the CF
/// conventions have it. So its size is always that of the cells. Metrics that a method does not report are NaN.
void write_summary(hdf5::File& file, const Summary& summary);

}  // namespace ridgeloc::results
