#pragma once

#include <filesystem>
#include <vector>

#include "results/blocks/block.hpp"
#include "results/blocks/failure_list.hpp"
#include "results/blocks/ledger.hpp"
#include "results/schema/schema.hpp"
#include "results/store/block_source.hpp"

namespace ridgeloc::results {

/// What a part file holds: finished blocks of a study, each with all or some of the methods, and the per-trial columns
/// of those whose columns are kept.
struct Part {
  Ledger ledger;
  FailureList failures;
  std::vector<TrialColumns> columns;
};

/// Writes a part under its name: complete, verified against what was meant, and durable, or not at all.
/// Throws core::IoError.
void write_part(const std::filesystem::path& path, const Header& header, const Part& part);

/// What a part says of itself. Throws core::IoError if it is damaged, and core::InputError if it is of another version
/// of the format.
Header read_part_header(const std::filesystem::path& path);

/// The blocks of a part, numbered as `wanted` numbers them. Throws core::IoError if the file is damaged, and
/// core::InputError if it belongs to another study, instruction set, version of the experiment or of the format.
BlockSource read_part_blocks(const std::filesystem::path& path, const Header& wanted);

}  // namespace ridgeloc::results
