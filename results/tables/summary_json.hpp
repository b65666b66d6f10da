#pragma once

#include <iosfwd>

#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// One JSON object: title, experiment, experiment_version, seed, trials, study_hash, isa; axes and methods; and rows,
/// one for each cell, method and metric, with the columns that `write_summary_csv` has: the cell's factors by name
/// under "cell", then method, metric, unit, n, trusted, beyond, the numbers and rms_trusted. Numbers read back as the
/// same bits; null stands for one that is not defined or infinite. Throws core::IoError when `out` fails.
void write_summary_json(const Summary& summary, std::ostream& out);

}  // namespace ridgeloc::results
