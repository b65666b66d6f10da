#pragma once

#include <filesystem>
#include <string>

namespace ridgeloc::results {

/// An advisory lock on a folder, held while the object lives and dropped by the system when the process dies. It is
/// taken on the file `lock` in the folder, opened for writing: network file systems lock neither folders nor what is
/// opened for reading alone.
///
/// Where the file system has no locks, two holders are not kept apart, but the first can find out by the mark that the
/// second has set.
class FolderLock {
 public:
  /// Makes the folder, if its last holder has removed it. Throws core::InputError if another process holds it for a
  /// second, core::IoError if the file cannot be opened or is another one each time.
  explicit FolderLock(const std::filesystem::path& folder);
  /// Removes the file, which nobody else can hold then, and lets others in.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// Why the file system cannot lock; empty where it can.
  const std::string& failure() const { return failure_; }

  /// Says in the file that this is its holder. Throws core::IoError.
  void mark();

  /// Throws core::IoError if there are no locks, and the mark is another one's.
  void require_alone() const;

 private:
  bool is_named() const;
  bool is_marked() const;

  std::filesystem::path file_;
  std::string mark_;
  std::string failure_;
  int descriptor_ = -1;
};

}  // namespace ridgeloc::results
