#pragma once
// Internal to results: finished blocks in a file, a part or a sealed result, as another study numbers them.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "results/blocks/block.hpp"
#include "results/blocks/failure_list.hpp"
#include "results/blocks/ledger.hpp"
#include "results/hdf5/hdf5.hpp"
#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// Where a file holds the values of the trials of one block, for one method.
struct StoredColumns {
  std::size_t cell = 0;
  std::size_t method = 0;
  std::uint64_t block = 0;
  std::uint64_t trials = 0;  ///< that the file holds
  std::uint64_t wanted = 0;  ///< of these, the first: what is to be read
  std::string group;         ///< of a sealed result: /trials/...; empty in a part
  bool has_status = false;
  std::vector<std::uint8_t> has_metric;  ///< per `Schema::metrics`
  std::uint64_t status_offset = 0;
  std::uint64_t value_offset = 0;
};

/// A file that has been checked against its digest or checksum, and what it holds.
struct BlockSource {
  std::filesystem::path path;
  Ledger ledger;
  FailureList failures;
  std::vector<StoredColumns> columns;
};

/// Reads the values of some blocks of a source.
std::vector<TrialColumns> read_columns(const std::filesystem::path& path, const Schema& schema,
                                       const std::vector<StoredColumns>& stored);

/// Throws core::InputError, which begins with `what`, unless the blocks of a file with the header `found` may stand
/// beside those of `wanted`: the same study hash, version of the experiment and schema, block size and instruction set.
void require_same_study(const Header& found, const Header& wanted, const std::string& what);

/// Turns the numbers of cells and methods from those of `found` into those of `wanted`, by their hashes. A cell or
/// method that `wanted` has not throws core::InputError; a method that it has twice, under two labels, is doubled.
void renumber(BlockSource& source, const Header& found, const Header& wanted);

/// The blocks of a sealed result. Throws core::InputError if it is damaged or of another study.
BlockSource read_result_blocks(const std::filesystem::path& path, const Header& wanted);

}  // namespace ridgeloc::results
