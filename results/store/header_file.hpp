#pragma once
// Internal to results: `Header` in a result file.

#include "results/hdf5/hdf5.hpp"
#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// Writes root attributes, /axes, /cells, /methods, /metrics, /events and /figures; the study's text goes
/// with the provenance.
void write_header(hdf5::File& file, const Header& header);

/// Throws core::IoError if something is missing or contradicts the rest.
Header read_header(const hdf5::File& file);

}  // namespace ridgeloc::results
