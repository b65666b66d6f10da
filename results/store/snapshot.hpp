#pragma once

#include <filesystem>

#include "results/blocks/failure_list.hpp"
#include "results/blocks/ledger.hpp"
#include "results/schema/schema.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// What there was of a result at one moment, but for the values of single trials.
struct Snapshot {
  Header header;
  Ledger ledger;
  FailureList failures;
  bool is_sealed = true;  ///< false: of parts, which a run has left or still adds to
};

/// What a snapshot is taken of: the sealed result or, where there is none yet, the parts; or both of them together.
enum class SnapshotOf { Result, ResultAndParts };

/// Takes a snapshot, beside a run that writes the result: it waits for nobody, nobody waits for it, and what it counts
/// was finished. A later one has all blocks that an earlier one had. Parts that are damaged are passed over.
///
/// Throws core::InputError, one line, if there is neither a result nor a part that can be read, or if the result is
/// damaged; core::IoError if two parts have different numbers for one block.
Snapshot read_snapshot(const std::filesystem::path& path, SnapshotOf of = SnapshotOf::Result);

/// The totals of each cell and method.
Summary summarize(const Snapshot& snapshot);

}  // namespace ridgeloc::results
