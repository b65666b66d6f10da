#include "results/store/result_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "results/store/block_union.hpp"
#include "results/store/parts_folder.hpp"
#include "results/store/result_file.hpp"
#include "results/store/result_seal.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

/// A part is due when this much is waiting, which bounds memory ...
constexpr std::size_t part_bytes = std::size_t{32} << 20;
/// ... or when the last one is this old, which bounds what a killed run loses. It decides how blocks fall
/// into parts and nothing else.
constexpr std::chrono::seconds part_age{5};

/// When so many parts are small, they become one, so that a run of days does not leave a file for every few seconds.
constexpr std::size_t most_small_parts = 64;
constexpr std::uintmax_t small_part_bytes = std::uintmax_t{1} << 20;

}  // namespace

ResultWriter::ResultWriter(ResultClaim claim, Header header, Totals totals)
    : claim_(std::move(claim)),
      path_(claim_->path()),
      folder_(claim_->folder()),
      header_(std::move(header)),
      present_(header_.cells.size() * header_.methods.size()),
      pending_(new_part()),
      last_part_(std::chrono::steady_clock::now()) {
  if (totals == Totals::Kept) totals_.emplace(header_.block_trials);
  adopt_result();
  adopt_parts();
}

ResultWriter::~ResultWriter() {
  if (!claim_) return;  // sealed
  try {
    flush();
  } catch (const std::exception&) {
    // Nobody is left to tell. The finished parts are on the disk; the blocks of this one will be computed
    // again.
  }
}

void ResultWriter::record(std::function<RunRecord()> now) {
  recorder_.emplace(folder_, std::move(now));
}

Part ResultWriter::new_part() const {
  return {Ledger(header_.block_trials), {}, {}};
}

void ResultWriter::adopt_result() {
  has_result_ = path_exists(path_);
  if (!has_result_) return;
  mark_present(read_result_blocks(path_, header_));
  is_same_study_ = read_result_header(path_).study_toml == header_.study_toml;
}

void ResultWriter::adopt_parts() {
  const PartsFolderContent content = content_of(folder_);
  std::error_code ignored;
  for (const fs::path& temporary : content.temporaries) fs::remove(temporary, ignored);
  for (const fs::path& part : content.parts) {
    try {
      mark_present(read_part_blocks(part, header_));
      parts_.push_back(part);
    } catch (const core::IoError& error) {
      damaged_parts_.push_back(part);
      warnings_.push_back(fmt::format("ignored, its blocks are computed again: {}", error.what()));
    }
  }
  // Damaged parts keep their names until the result is sealed, and none is overwritten. Later parts have larger
  // numbers.
  if (!content.parts.empty()) next_part_ = part_number(content.parts.back()) + 1;
}

void ResultWriter::mark_present(const BlockSource& source) {
  for (const Row& row : source.ledger.rows()) mark_present(row);
  for (const StoredColumns& stored : source.columns)
    present(stored.cell, stored.method).columns.insert(stored.block, 1, stored.trials, header_.block_trials);
}

void ResultWriter::mark_present(const Row& row) {
  present(row.cell, row.method).blocks.insert(row.first_block, row.blocks, row.statistics.trials, header_.block_trials);
  if (totals_) totals_->insert(row);
}

void ResultWriter::mark_present(const TrialColumns& columns) {
  present(columns.cell, columns.method).columns.insert(columns.block, 1, columns.trials, header_.block_trials);
}

ResultWriter::Present& ResultWriter::present(std::size_t cell, std::size_t method) {
  std::unique_ptr<Present>& place = present_.at(cell * header_.methods.size() + method);
  if (place == nullptr) place = std::make_unique<Present>();
  return *place;
}

const ResultWriter::Present& ResultWriter::present(std::size_t cell, std::size_t method) const {
  static const Present nothing;
  const std::unique_ptr<Present>& place = present_.at(cell * header_.methods.size() + method);
  return place == nullptr ? nothing : *place;
}

std::vector<std::size_t> ResultWriter::missing_methods(std::size_t cell, std::uint64_t block, std::uint64_t trials,
                                                       const std::vector<std::size_t>& methods) const {
  const std::uint64_t kept = kept_trials(header_, block, trials);
  std::vector<std::size_t> missing;
  const std::lock_guard lock(state_mutex_);
  for (const std::size_t method : methods) {
    const Present& there = present(cell, method);
    const bool has_columns = !header_.methods[method].difference;
    if (!there.blocks.contains(block, trials) || (kept > 0 && has_columns && !there.columns.contains(block, kept)))
      missing.push_back(method);
  }
  return missing;
}

std::uint64_t ResultWriter::blocks_there(std::size_t cell, std::uint64_t trials,
                                         const std::vector<std::size_t>& methods) const {
  std::uint64_t fewest = std::numeric_limits<std::uint64_t>::max();
  const std::lock_guard lock(state_mutex_);
  for (const std::size_t method : methods) {
    const Coverage& blocks = present(cell, method).blocks;
    fewest = std::min(fewest, blocks.count(trials, header_.block_trials));
  }
  return fewest;
}

std::uint64_t ResultWriter::values_there(std::size_t cell, std::uint64_t trials, std::size_t method) const {
  const std::lock_guard lock(state_mutex_);
  return present(cell, method).columns.count(trials, header_.block_trials);
}

ResultWriter::Extent ResultWriter::extent(std::size_t cell, std::uint64_t trials,
                                          const std::vector<std::size_t>& methods) const {
  Extent extent{std::numeric_limits<std::uint64_t>::max(), 0};
  const std::lock_guard lock(state_mutex_);
  for (const std::size_t method : methods) {
    const Coverage& blocks = present(cell, method).blocks;
    extent.unbroken = std::min(extent.unbroken, blocks.unbroken(trials, header_.block_trials));
    extent.end = std::max(extent.end, blocks.end());
  }
  return extent;
}

Statistics ResultWriter::statistics(std::size_t cell, std::size_t method) const {
  const std::lock_guard lock(state_mutex_);
  return totals_->total(cell, method);
}

bool ResultWriter::is_current() const {
  return is_same_study_ && parts_.empty() && damaged_parts_.empty() && pending_.ledger.size() == 0;
}

void ResultWriter::add(std::vector<BlockSink> blocks) {
  Part due = new_part();
  {
    const std::lock_guard lock(state_mutex_);
    for (BlockSink& block : blocks) {
      for (TrialColumns& columns : block.take_columns()) {
        mark_present(columns);
        pending_column_bytes_ += columns.bytes();
        pending_.columns.push_back(std::move(columns));
      }
      for (Row& row : block.take_rows()) {
        mark_present(row);
        pending_.ledger.insert(std::move(row));
      }
      pending_.failures.insert(block.take_failures());
    }
    const bool is_old = std::chrono::steady_clock::now() - last_part_ > part_age;
    if (is_old || pending_.ledger.bytes() + pending_column_bytes_ > part_bytes) due = take_pending();
  }
  write(due);
}

void ResultWriter::flush() {
  Part due = new_part();
  {
    const std::lock_guard lock(state_mutex_);
    due = take_pending();
  }
  write(due);
}

Part ResultWriter::take_pending() {
  last_part_ = std::chrono::steady_clock::now();
  pending_column_bytes_ = 0;
  return std::exchange(pending_, new_part());
}

void ResultWriter::write(const Part& part) {
  if (part.ledger.size() == 0) return;
  const std::lock_guard lock(parts_mutex_);
  claim_->require_alone();
  const fs::path path = next_part_path();
  write_part(path, header_, part);
  parts_.push_back(path);
  unite_small_parts();
}

fs::path ResultWriter::next_part_path() {
  fs::path path;
  do {
    path = folder_ / part_name(next_part_++);
  } while (fs::exists(path));
  return path;
}

void ResultWriter::unite_small_parts() {
  std::vector<fs::path> small, others;
  for (const fs::path& part : parts_) {
    std::error_code unknown;  // a vanished part is found out when the result is sealed
    (fs::file_size(part, unknown) <= small_part_bytes ? small : others).push_back(part);
  }
  if (small.size() < most_small_parts) return;
  Part united = new_part();
  for (const fs::path& path : small) {
    const BlockSource source = read_part_blocks(path, header_);
    for (const Row& row : source.ledger.rows()) united.ledger.insert(row);
    united.failures.insert(source.failures);
    std::ranges::move(read_columns(path, header_.schema, source.columns), std::back_inserter(united.columns));
  }
  const fs::path path = next_part_path();
  write_part(path, header_, united);
  others.push_back(path);
  parts_ = std::move(others);
  // A kill in between leaves blocks twice, which counts once.
  std::error_code ignored;
  for (const fs::path& part : small) fs::remove(part, ignored);
}

void ResultWriter::require_complete(const Ledger& ledger) const {
  std::vector<std::uint64_t> trials(present_.size(), 0);
  for (const Row& row : ledger.rows()) trials[row.cell * header_.methods.size() + row.method] += row.statistics.trials;
  std::size_t missing = 0;
  for (std::size_t i = 0; i < trials.size(); ++i)
    if (present_[i] != nullptr && trials[i] < present_[i]->blocks.trials(header_.block_trials)) ++missing;
  if (missing > 0)
    throw core::IoError(fmt::format("{} of {} pairs of cell and method lack trials that were computed: {} was changed",
                                    missing, trials.size(), folder_.string()));
}

void ResultWriter::seal(const Provenance& provenance) {
  flush();
  const std::lock_guard lock(parts_mutex_);
  claim_->require_alone();
  // A merge does not hold the lock, and what it has written here would be lost.
  if (!has_result_ && path_exists(path_))
    throw core::IoError(fmt::format("{} has appeared while the study ran, and is not replaced", path_.string()));
  BlockUnion blocks(header_);
  if (has_result_) blocks.add(read_result_blocks(path_, header_));
  for (const fs::path& part : parts_) blocks.add(read_part_blocks(part, header_));
  require_complete(blocks.ledger());
  Provenance all = provenance;
  if (has_result_) all.contributions = contributions_of(path_);
  write_result(path_, header_, blocks, all);
  // The result is complete: what cannot be removed now is only in the way.
  std::error_code ignored;
  for (const fs::path& part : parts_) fs::remove(part, ignored);
  for (const fs::path& part : damaged_parts_) fs::remove(part, ignored);
  recorder_.reset();
  claim_.reset();
}

}  // namespace ridgeloc::results
