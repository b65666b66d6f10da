#include "results/result_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "results/hdf5.hpp"
#include "results/result_seal.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

/// A part is due when this much is waiting, which bounds memory ...
constexpr std::size_t part_bytes = std::size_t{32} << 20;
/// ... or when the last one is this old, which bounds what a killed run loses. It decides how blocks fall
/// into parts and nothing else.
constexpr std::chrono::seconds part_age{5};

constexpr const char* part_extension = ".h5";

/// Every cell must have all its trials before the result may say so: parts may have been taken away meanwhile.
void require_complete(const Ledger& ledger, const Header& header, const fs::path& folder) {
  std::vector<std::uint64_t> trials(header.cells.size() * header.methods.size(), 0);
  for (const Row& row : ledger.rows()) trials[row.cell * header.methods.size() + row.method] += row.statistics.trials;
  const auto missing = std::ranges::count_if(trials, [&](std::uint64_t present) { return present < header.trials; });
  if (missing > 0)
    throw core::IoError(fmt::format("{} of {} pairs of cell and method lack trials that were computed: {} was changed",
                                    missing, trials.size(), folder.string()));
}

/// Where the kept columns of one cell are: per part, its entries.
using CellIndex = std::map<fs::path, std::vector<PartReader::Entry>>;

}  // namespace

std::optional<std::string> isa_of_unfinished(const fs::path& path) {
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(path.string() + ".parts", none)) {
    if (entry.path().extension() != part_extension || TemporaryFile::is_temporary(entry.path())) continue;
    try {
      return hdf5::File::open(entry.path()).text_attribute("/", "isa");
    } catch (const core::IoError&) {
      // Damaged: another part may tell, and the writer reports this one.
    }
  }
  return std::nullopt;
}

ResultWriter::ResultWriter(fs::path path, Header header)
    : path_(std::move(path)),
      folder_(path_.string() + ".parts"),
      header_(std::move(header)),
      done_(header_.cells.size()),
      pending_(new_part()),
      last_part_(std::chrono::steady_clock::now()) {
  require_writable(path_);
  std::error_code error;
  fs::create_directory(folder_, error);
  if (error)
    throw core::InputError(
        fmt::format("cannot create the folder {}: {}; choose another -o", folder_.string(), error.message()));
  lock_ = std::make_unique<FolderLock>(folder_);
  TemporaryFile::remove_leftovers(path_);
  if (fs::exists(path_, error)) {
    remove_folder_if_empty();
    throw core::InputError(fmt::format("{} exists; choose another -o or remove it", path_.string()));
  }
  adopt_parts();
}

ResultWriter::~ResultWriter() {
  if (lock_ == nullptr) return;  // sealed
  try {
    flush();
  } catch (const std::exception&) {
    // Nobody is left to tell. The finished parts are on the disk; the blocks of this one will be computed
    // again.
  }
  remove_folder_if_empty();
}

Part ResultWriter::new_part() const {
  return {Ledger(header_.block_trials), {}};
}

void ResultWriter::adopt_parts() {
  std::vector<fs::path> found;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    std::error_code ignored;
    if (TemporaryFile::is_temporary(entry.path())) {
      fs::remove(entry.path(), ignored);
    } else if (entry.path().extension() == part_extension) {
      found.push_back(entry.path());
    }
  }
  std::ranges::sort(found);
  for (const fs::path& part : found) {
    try {
      mark_done(PartReader(part, header_).ledger());
      parts_.push_back(part);
    } catch (const core::IoError& error) {
      damaged_parts_.push_back(part);
      warnings_.push_back(fmt::format("ignored, its blocks are computed again: {}", error.what()));
    }
  }
  // Damaged parts keep their names until the result is sealed, and none is overwritten.
  next_part_ = found.size();
  for (const BlockSet& blocks : done_) adopted_blocks_ += blocks.size();
}

void ResultWriter::mark_done(const Ledger& ledger) {
  // Each block comes with all methods, so that the rows of the first one name them.
  for (const Row& row : ledger.rows())
    if (row.method == 0) done_[row.cell].insert(row.first_block, row.blocks);
}

bool ResultWriter::contains(std::size_t cell, std::uint64_t block) const {
  const std::lock_guard lock(state_mutex_);
  return done_.at(cell).contains(block);
}

void ResultWriter::add(std::vector<BlockSink> blocks) {
  Part due = new_part();
  {
    const std::lock_guard lock(state_mutex_);
    for (BlockSink& block : blocks) {
      done_.at(block.cell()).insert(block.block(), 1);
      for (TrialColumns& columns : block.take_columns()) {
        pending_column_bytes_ += columns.bytes();
        pending_.columns.push_back(std::move(columns));
      }
      for (Row& row : block.take_rows()) pending_.ledger.insert(std::move(row));
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
  fs::path path;
  do {
    path = folder_ / fmt::format("part-{:06}{}", next_part_++, part_extension);
  } while (fs::exists(path));
  write_part(path, header_, part);
  parts_.push_back(path);
}

void ResultWriter::seal(const Provenance& provenance) {
  flush();
  const std::lock_guard lock(parts_mutex_);
  Ledger ledger(header_.block_trials);
  std::vector<CellIndex> index(header_.cells.size());
  for (const fs::path& path : parts_) {
    const PartReader part(path, header_);
    for (const Row& row : part.ledger().rows()) ledger.insert(row);
    for (const PartReader::Entry& entry : part.entries()) index.at(entry.cell)[path].push_back(entry);
  }
  require_complete(ledger, header_, folder_);

  const auto columns_of = [&index](std::size_t cell) {
    std::vector<TrialColumns> columns;
    for (const auto& [path, entries] : index[cell])
      for (TrialColumns& block : read_columns(path, entries)) columns.push_back(std::move(block));
    return columns;
  };
  write_result(path_, header_, ledger, columns_of, provenance);
  // The result is complete: what cannot be removed now is only in the way.
  std::error_code ignored;
  for (const fs::path& part : parts_) fs::remove(part, ignored);
  for (const fs::path& part : damaged_parts_) fs::remove(part, ignored);
  remove_folder_if_empty();
  lock_.reset();
}

void ResultWriter::remove_folder_if_empty() {
  // What the program did not put there is not its to remove; the folder then stays.
  std::error_code not_empty;
  fs::remove(folder_, not_empty);
}

}  // namespace ridgeloc::results
