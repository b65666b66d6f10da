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

/// A run says how far it is every two seconds.
constexpr double living_s = 20.0;

/// Throws core::InputError if a run has said that it goes on, moments ago.
void refuse_living_run(const fs::path& folder) {
  const auto found = find_run_record(folder);
  if (!found || found->record.state == RunRecord::State::Stopped || found->age_s > living_s) return;
  throw core::InputError(fmt::format(
      "{}: process {} on {} seems to be writing there, {:.0f} s ago, and this file system has no locks; wait "
      "for it, stop it, or choose another -o",
      folder.string(), found->record.process, found->record.machine, found->age_s));
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
