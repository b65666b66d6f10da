#include "results/store/result_claim.hpp"

#include <system_error>
#include <utility>

#include "results/store/parts_folder.hpp"
#include "results/store/run_record.hpp"

namespace ridgeloc::results {

namespace fs = std::filesystem;

ResultClaim::ResultClaim(fs::path path) : path_(std::move(path)), folder_(parts_folder(path_)) {
  require_writable(path_);
  make_folder(folder_);
  lock_ = std::make_unique<FolderLock>(folder_);
  TemporaryFile::remove_leftovers(path_);
}

ResultClaim::~ResultClaim() {
  if (lock_ == nullptr) return;
  std::error_code ignored;
  if (content_of(folder_).parts.empty()) fs::remove(run_record_file(folder_), ignored);
  // What the program did not put there is not its to remove; the folder then stays.
  fs::remove(folder_, ignored);
}

}  // namespace ridgeloc::results
