#pragma once

#include <filesystem>
#include <vector>

#include "results/block.hpp"
#include "results/ledger.hpp"
#include "results/schema.hpp"

namespace ridgeloc::results {

/// What a part file holds: finished blocks of a study, whole (each with all methods), and the per-trial
/// columns of those whose columns are kept.
struct Part {
  Ledger ledger;
  std::vector<TrialColumns> columns;
};

/// Writes a part under its name: complete, verified against what was meant, and durable, or not at all.
/// Throws core::IoError.
void write_part(const std::filesystem::path& path, const Header& header, const Part& part);

/// An open part file whose content has been checked against its checksum.
class PartReader {
 public:
  /// Throws core::IoError if the file is damaged, and core::InputError if it belongs to another study,
  /// instruction set, version of the experiment or of the format.
  PartReader(const std::filesystem::path& path, const Header& header);

  const Ledger& ledger() const { return ledger_; }

  /// Which block, cell and method each of the stored column sets is of, and where it lies.
  struct Entry {
    std::size_t cell = 0;
    std::size_t method = 0;
    std::uint64_t block = 0;
    std::uint64_t trials = 0;
    bool has_status = false;
    std::vector<std::uint8_t> has_metric;
    std::uint64_t status_offset = 0;
    std::uint64_t value_offset = 0;
  };
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  Ledger ledger_;
  std::vector<Entry> entries_;
};

/// Columns of some entries of a part that a `PartReader` has checked, in the order asked for.
std::vector<TrialColumns> read_columns(const std::filesystem::path& path,
                                       const std::vector<PartReader::Entry>& entries);

}  // namespace ridgeloc::results
