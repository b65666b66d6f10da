#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "results/blocks/block.hpp"
#include "results/blocks/coverage.hpp"
#include "results/schema/schema.hpp"
#include "results/store/part.hpp"
#include "results/store/provenance.hpp"
#include "results/store/result_claim.hpp"
#include "results/store/run_record.hpp"

namespace ridgeloc::results {

/// Collects the finished blocks of a study and makes its result file.
///
/// Blocks go to immutable part files in `<path>.parts/` every few seconds or megabytes, so that memory stays
/// flat and a killed program loses little; `seal` turns what `<path>` held before, and the parts, into a new `<path>`.
/// The data of the result do not depend on the order of blocks, on how they fell into parts, or on interruptions. If
/// anything fails, the finished parts stay and the same study goes on from there.
///
/// `missing_methods`, `blocks_there`, `values_there`, `extent`, `statistics`, `add` and `flush` may be called from any
/// thread.
class ResultWriter {
 public:
  /// Takes over what the result holds and what a stopped run has left. All of that must be of the study that the header
  /// describes, and in it: throws core::InputError otherwise.
  ///
  /// With `Totals::Kept` the statistics of all blocks stay in memory, for `statistics`.
  enum class Totals { Dropped, Kept };
  ResultWriter(ResultClaim claim, Header header, Totals totals = Totals::Dropped);
  /// The same, where nothing of the result was read before it is claimed.
  ResultWriter(const std::filesystem::path& path, Header header, Totals totals = Totals::Dropped)
      : ResultWriter(ResultClaim(path), std::move(header), totals) {}
  /// Keeps what was added as a part if that is possible.
  ~ResultWriter();
  ResultWriter(const ResultWriter&) = delete;
  ResultWriter& operator=(const ResultWriter&) = delete;

  /// One line for each part that was found damaged and is ignored: its blocks count as missing.
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Those of the methods, as the header numbers them, that lack the block with so many trials, or the values of its
  /// trials where the study keeps them.
  std::vector<std::size_t> missing_methods(std::size_t cell, std::uint64_t block, std::uint64_t trials,
                                           const std::vector<std::size_t>& methods) const;

  /// How many of the blocks that `trials` trials of a cell make are there; of the method that has the fewest.
  std::uint64_t blocks_there(std::size_t cell, std::uint64_t trials, const std::vector<std::size_t>& methods) const;

  /// The same of the values of the first `trials` trials; of a method that gives none there are none.
  std::uint64_t values_there(std::size_t cell, std::uint64_t trials, std::size_t method) const;

  /// How far a cell is for some methods: how many of the blocks that `trials` trials make all have from the first on
  /// without a gap (more if there are more whole ones), and one past the last block that any has.
  struct Extent {
    std::uint64_t unbroken = 0;
    std::uint64_t end = 0;
  };
  Extent extent(std::size_t cell, std::uint64_t trials, const std::vector<std::size_t>& methods) const;

  /// Of all trials that a method has in a cell. Precondition: totals are kept.
  Statistics statistics(std::size_t cell, std::size_t method) const;

  /// Whether the sealed result is as `seal` would make it now: nothing was added, and it says of itself what the header
  /// says.
  bool is_current() const;

  /// Lets others see how far the run is, until the result is sealed or the writer gone. `now` is asked from another
  /// thread.
  void record(std::function<RunRecord()> now);

  /// Takes finished blocks. Throws core::IoError if a part cannot be written.
  void add(std::vector<BlockSink> blocks);

  /// Writes what was added since the last part as a part.
  void flush();

  /// Makes the result file and removes the parts. Nothing may be added afterwards.
  /// Throws core::IoError, and then the parts and what was there before stay.
  void seal(const Provenance& provenance);

 private:
  /// What is there of one method in one cell.
  struct Present {
    Coverage blocks;
    Coverage columns;
  };

  void adopt_result();
  void adopt_parts();
  void mark_present(const BlockSource& source);
  void mark_present(const Row& row);
  void mark_present(const TrialColumns& columns);
  Present& present(std::size_t cell, std::size_t method);
  const Present& present(std::size_t cell, std::size_t method) const;
  Part new_part() const;
  Part take_pending();
  void write(const Part& part);
  std::filesystem::path next_part_path();
  void unite_small_parts();
  void require_complete(const Ledger& ledger) const;

  std::optional<ResultClaim> claim_;  ///< none once the result is sealed
  std::filesystem::path path_;
  std::filesystem::path folder_;
  Header header_;
  bool has_result_ = false;     ///< whether `path_` is a result that this one goes on from
  bool is_same_study_ = false;  ///< whether that one's study is this one to the letter
  std::vector<std::string> warnings_;
  std::vector<std::filesystem::path> damaged_parts_;

  mutable std::mutex state_mutex_;  ///< guards the next five
  /// cell * methods + method; null: nothing. Of a million cells most may have nothing yet.
  std::vector<std::unique_ptr<Present>> present_;
  std::optional<Ledger> totals_;  ///< if they are kept
  Part pending_;
  std::size_t pending_column_bytes_ = 0;
  std::chrono::steady_clock::time_point last_part_;

  std::mutex parts_mutex_;  ///< guards the next two
  std::vector<std::filesystem::path> parts_;
  std::uint64_t next_part_ = 0;

  std::optional<RunRecorder> recorder_;  ///< last: its thread may ask for what is above
};

}  // namespace ridgeloc::results
