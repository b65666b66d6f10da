#pragma once

#include <filesystem>
#include <memory>

#include "results/util/file_system.hpp"

namespace ridgeloc::results {

/// The right to write a result, held by one run at a time. What is read of the result while it is held does not change
/// but by its holder.
class ResultClaim {
 public:
  /// Makes the folder of the parts and locks it, and removes what killed programs have left of the result. Throws
  /// core::InputError if `path` cannot be written, or if another run is writing to it.
  explicit ResultClaim(std::filesystem::path path);
  /// Removes the folder if there are no parts in it, and lets others write.
  ~ResultClaim();
  ResultClaim(ResultClaim&&) noexcept = default;
  ResultClaim& operator=(ResultClaim&&) = delete;

  const std::filesystem::path& path() const { return path_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  std::filesystem::path path_;
  std::filesystem::path folder_;
  std::unique_ptr<FolderLock> lock_;  ///< null: moved from
};

}  // namespace ridgeloc::results
