#pragma once
// Internal to results: the group /summary, which xarray opens with named axes.

#include "results/hdf5/hdf5.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// Writes one dimension scale per sweep axis, "method" and "statistic", and for each metric and event an
/// array over (axes..., method, statistic). Points of the grid that are no cell, and metrics that a method
/// does not report, are NaN.
void write_summary(hdf5::File& file, const Summary& summary);

}  // namespace ridgeloc::results
