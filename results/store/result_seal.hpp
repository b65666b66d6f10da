#pragma once
// Internal to results: writing a sealed result.

#include <filesystem>

#include "results/schema/schema.hpp"
#include "results/store/block_union.hpp"
#include "results/store/provenance.hpp"

namespace ridgeloc::results {

/// Writes a result under its name: complete, verified by reading it back, and durable, or not at all. Only one cell's
/// values of single trials are in memory at a time. Throws core::IoError.
void write_result(const std::filesystem::path& path, const Header& header, const BlockUnion& blocks,
                  const Provenance& provenance);

}  // namespace ridgeloc::results
