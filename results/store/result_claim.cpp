#include "results/store/result_claim.hpp"

#include <fmt/format.h>

#include <system_error>
#include <utility>

#include "core/error.hpp"
#include "results/store/parts_folder.hpp"
#include "results/store/run_record.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::results {

namespace fs = std::filesystem;

namespace {

/// Throws core::InputError if a run says that it goes on.
void refuse_living_run(const fs::path& folder) {
  const auto run = find_living_run(folder);
  if (!run) return;
  throw core::InputError(fmt::format(
      "{}: process {} on {} is writing there, and this file system has no locks; wait for it, stop it, or choose "
      "another -o",
      folder.string(), run->process, run->machine));
}

}  // namespace

ResultClaim::ResultClaim(fs::path path) : path_(std::move(path)), folder_(parts_folder(path_)) {
  require_writable(path_);
  make_folder(folder_);
  lock_ = std::make_unique<FolderLock>(folder_);
  if (!lock_failure().empty()) {
    refuse_living_run(folder_);
    lock_->mark();
  }
  TemporaryFile::remove_leftovers(path_);
}

ResultClaim::~ResultClaim() {
  if (lock_ == nullptr) return;
  std::error_code ignored;
  if (content_of(folder_).parts.empty()) fs::remove(run_record_file(folder_), ignored);
  // After the lock: some network file systems keep a file that is open, and with it its folder. What the program did
  // not put there is not its to remove, nor what another run has put there by now; the folder then stays.
  lock_.reset();
  fs::remove(folder_, ignored);
}

}  // namespace ridgeloc::results
