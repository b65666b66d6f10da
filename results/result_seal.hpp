#pragma once
// Internal to results: writing a sealed result.

#include <filesystem>
#include <functional>
#include <vector>

#include "results/block.hpp"
#include "results/ledger.hpp"
#include "results/provenance.hpp"
#include "results/schema.hpp"

namespace ridgeloc::results {

/// The kept columns of one cell, in any order; called once per cell, so that only one cell's are in memory.
using ColumnSource = std::function<std::vector<TrialColumns>(std::size_t cell)>;

/// Writes a result under its name: complete, verified by reading it back, and durable, or not at all.
/// Throws core::IoError.
void write_result(const std::filesystem::path& path, const Header& header, const Ledger& ledger,
                  const ColumnSource& columns, const Provenance& provenance);

}  // namespace ridgeloc::results
