#pragma once

#include <filesystem>
#include <vector>

#include "results/schema/schema.hpp"
#include "results/store/provenance.hpp"

namespace ridgeloc::results {

/// Writes the union of the blocks of several sealed results, which need not be complete, as one. `header` must have
/// every cell and method of each; the data do not depend on the order of the inputs.
///
/// Throws core::InputError if an input is damaged, of another study, or of another instruction set than the header's
/// (unless that is `mixed_isa`), or if `output` exists or cannot be written; core::IoError if two inputs have different
/// numbers for the same block, or writing fails.
void merge_results(const std::vector<std::filesystem::path>& inputs, const std::filesystem::path& output,
                   const Header& header, const Provenance& provenance);

}  // namespace ridgeloc::results
