#pragma once
// Internal to results: a `Ledger` in a result or part file.

#include <string>

#include "results/blocks/ledger.hpp"
#include "results/hdf5/hdf5.hpp"
#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// Writes the group /ledger.
void write_ledger(hdf5::File& file, const Ledger& ledger, const Schema& schema);

/// Throws core::IoError if the group does not fit the header.
Ledger read_ledger(const hdf5::File& file, const Header& header);

}  // namespace ridgeloc::results
