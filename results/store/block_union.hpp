#pragma once
// Internal to results: the blocks of several files together.

#include <cstddef>
#include <filesystem>
#include <map>
#include <vector>

#include "results/blocks/failure_list.hpp"
#include "results/blocks/ledger.hpp"
#include "results/schema/schema.hpp"
#include "results/store/block_source.hpp"

namespace ridgeloc::results {

/// The union of the blocks of several sources. It does not depend on their order, nor on how blocks fell into them:
/// equal blocks are one, of a block that is there twice the longer one counts.
class BlockUnion {
 public:
  explicit BlockUnion(const Header& header);

  /// Throws core::IoError if a block is known with as many trials and other numbers; it names the file and the block.
  void add(BlockSource source);

  const Ledger& ledger() const { return ledger_; }
  const FailureList& failures() const { return failures_; }

  /// Values of the trials of the blocks of one cell whose trials the study keeps, sorted by method and block.
  std::vector<TrialColumns> columns(std::size_t cell) const;

 private:
  const Header& header_;
  Ledger ledger_;
  FailureList failures_;
  std::vector<std::map<std::filesystem::path, std::vector<StoredColumns>>> columns_;  ///< per cell
};

}  // namespace ridgeloc::results
