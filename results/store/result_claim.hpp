#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "results/util/folder_lock.hpp"

namespace ridgeloc::results {

/// The right to write a result, held by one run at a time. What is read of the result while it is held does not change
/// but by its holder.
class ResultClaim {
 public:
  /// Makes the folder of the parts and locks it, and removes what killed programs have left of the result. Throws
  /// core::InputError if `path` cannot be written, or if another run is writing to it: as its lock says or, where there
  /// are no locks, its record.
  explicit ResultClaim(std::filesystem::path path);
  /// Removes the folder if there are no parts in it, and lets others write.
  ~ResultClaim();
  ResultClaim(ResultClaim&&) noexcept = default;
  ResultClaim& operator=(ResultClaim&&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& folder() const { return folder_; }

  /// Why the file system of the result has no locks, so that two runs are not kept apart; empty where it has.
  const std::string& lock_failure() const { return lock_->failure(); }

  /// Throws core::IoError if there are no locks and another run has claimed the result since.
  void require_alone() const { lock_->require_alone(); }

 private:
  std::filesystem::path path_;
  std::filesystem::path folder_;
  std::unique_ptr<FolderLock> lock_;  ///< null: moved from
};

}  // namespace ridgeloc::results
