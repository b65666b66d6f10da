#include "results/util/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <iterator>
#include <thread>

#include "core/error.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

/// The file of the lock, made where it is not there, also with its folder. A link or anything but a file is refused:
/// the folder may be somebody else's.
int open_lock(const fs::path& file, int access) {
  const int flags = access | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
  constexpr mode_t as_the_user_allows = 0666;
  for (;;) {
    const int descriptor = ::open(file.c_str(), flags, as_the_user_allows);
    struct stat status {};
    if (descriptor >= 0 && ::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode)) return descriptor;
    const int error = descriptor < 0 ? errno : EEXIST;
    if (descriptor >= 0) ::close(descriptor);
    if (error != ENOENT) throw core::IoError(fmt::format("cannot lock {}: {}", file.string(), system_message(error)));
    make_folder(file.parent_path());
  }
}

/// 0, EWOULDBLOCK if another process has the lock, or why there are no locks.
int lock_error(int descriptor) {
  while (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
    if (errno != EINTR) return errno;
  return 0;
}

}  // namespace

FolderLock::FolderLock(const fs::path& folder) : file_(folder / "lock"), mark_(random_part()) {
  // A process that was killed lets go of its lock within moments, not at once: its memory is given back first.
  constexpr auto patience = std::chrono::seconds(1);
  constexpr auto pause = std::chrono::milliseconds(10);
  const auto deadline = std::chrono::steady_clock::now() + patience;
  for (;;) {
    descriptor_ = open_lock(file_, O_RDONLY);
    int error = lock_error(descriptor_);
    if (error != 0 && error != EWOULDBLOCK) {
      // NFS locks only what is open for writing, which elsewhere would keep a disk from being made read-only; and where
      // there are no locks a mark is written.
      ::close(descriptor_);
      descriptor_ = open_lock(file_, O_RDWR);
      error = lock_error(descriptor_);
    }
    const bool is_held = error == EWOULDBLOCK;
    failure_ = error == 0 || is_held ? "" : system_message(error);
    // The run that held the lock may have removed the file since it was opened: then this locks one without a name.
    if (!is_held && is_named()) return;
    ::close(descriptor_);
    if (std::chrono::steady_clock::now() >= deadline) {
      if (!is_held) throw core::IoError(fmt::format("cannot lock {}: it does not stay the same file", file_.string()));
      throw core::InputError(
          fmt::format("another run is writing to {}; wait for it, stop it, or choose another -o", folder.string()));
    }
    std::this_thread::sleep_for(pause);
  }
}

FolderLock::~FolderLock() {
  // While it is locked it cannot be another one's. Its folder may have been removed and made anew by other hands.
  if (is_named() && (failure_.empty() || is_marked())) ::unlink(file_.c_str());
  ::close(descriptor_);
}

void FolderLock::mark() {
  const bool written = ::ftruncate(descriptor_, 0) == 0 &&
                       ::write(descriptor_, mark_.data(), mark_.size()) == static_cast<ssize_t>(mark_.size());
  if (!written) throw core::IoError(fmt::format("cannot write {}: {}", file_.string(), system_message(errno)));
}

bool FolderLock::is_marked() const {
  std::ifstream file(file_, std::ios::binary);
  const std::string mark{std::istreambuf_iterator<char>(file), {}};
  return mark == mark_;
}

bool FolderLock::is_named() const {
  struct stat locked {};
  struct stat named {};
  return ::fstat(descriptor_, &locked) == 0 && ::stat(file_.c_str(), &named) == 0 && locked.st_dev == named.st_dev &&
         locked.st_ino == named.st_ino;
}

void FolderLock::require_alone() const {
  if (failure_.empty() || is_marked()) return;
  throw core::IoError(fmt::format(
      "{} was taken by another run meanwhile, which file locks would have kept away; let one of them finish",
      file_.parent_path().string()));
}

}  // namespace ridgeloc::results
