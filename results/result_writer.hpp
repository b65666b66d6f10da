#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "results/block.hpp"
#include "results/block_set.hpp"
#include "results/file_system.hpp"
#include "results/part.hpp"
#include "results/provenance.hpp"
#include "results/schema.hpp"

namespace ridgeloc::results {

/// The instruction set that computed what a stopped run has left of the result at `path`, if it has left anything.
std::optional<std::string> isa_of_unfinished(const std::filesystem::path& path);

/// Collects the finished blocks of a study and makes its result file.
///
/// Blocks go to immutable part files in `<path>.parts/` every few seconds or megabytes, so that memory stays
/// flat and a killed program loses little; `seal` turns the parts into `<path>`. The data of the result do
/// not depend on the order of blocks, on how they fell into parts, or on interruptions. If anything fails,
/// the finished parts stay and the same study goes on from there.
///
/// `contains`, `add` and `flush` may be called from any thread.
class ResultWriter {
 public:
  /// Checks that `path` can be written and does not exist, and takes over the parts that a stopped run of the same
  /// study has left. Throws core::InputError if it cannot or does, if the parts are of another study, or if another
  /// run is writing them.
  ResultWriter(std::filesystem::path path, Header header);
  /// Keeps what was added as a part if that is possible, and removes the folder of parts if there are none.
  ~ResultWriter();
  ResultWriter(const ResultWriter&) = delete;
  ResultWriter& operator=(const ResultWriter&) = delete;

  /// One line for each part that was found damaged and is ignored: its blocks count as missing.
  const std::vector<std::string>& warnings() const { return warnings_; }
  /// Number of blocks, counted over cells, that were taken over from a stopped run.
  std::uint64_t adopted_blocks() const { return adopted_blocks_; }

  bool contains(std::size_t cell, std::uint64_t block) const;

  /// Takes finished blocks. Throws core::IoError if a part cannot be written.
  void add(std::vector<BlockSink> blocks);

  /// Writes what was added since the last part as a part.
  void flush();

  /// Makes the result file from all parts and removes them. Nothing may be added afterwards.
  /// Throws core::IoError, and then the parts stay.
  void seal(const Provenance& provenance);

 private:
  void adopt_parts();
  void mark_done(const Ledger& ledger);
  Part new_part() const;
  Part take_pending();
  void write(const Part& part);
  void remove_folder_if_empty();

  std::filesystem::path path_;
  std::filesystem::path folder_;
  Header header_;
  std::unique_ptr<FolderLock> lock_;
  std::vector<std::string> warnings_;
  std::vector<std::filesystem::path> damaged_parts_;
  std::uint64_t adopted_blocks_ = 0;

  mutable std::mutex state_mutex_;  ///< guards the next four
  std::vector<BlockSet> done_;      ///< per cell
  Part pending_;
  std::size_t pending_column_bytes_ = 0;
  std::chrono::steady_clock::time_point last_part_;

  std::mutex parts_mutex_;  ///< guards the next two
  std::vector<std::filesystem::path> parts_;
  std::uint64_t next_part_ = 0;
};

}  // namespace ridgeloc::results
