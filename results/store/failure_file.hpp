#pragma once
// Internal to results: a `FailureList` in a result or part file.

#include "results/blocks/failure_list.hpp"
#include "results/hdf5/hdf5.hpp"
#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// Writes the group /failures.
void write_failures(hdf5::File& file, const FailureList& failures, const Schema& schema);

/// Empty where the file is of a version without the group. Throws core::IoError if it does not fit the header.
FailureList read_failures(const hdf5::File& file, const Header& header);

}  // namespace ridgeloc::results
