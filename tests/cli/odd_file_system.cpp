// Loaded before the program (LD_PRELOAD): a file system that cannot do what others can, as the environment says.
// FOLDER_SYNC_ERROR: with this error folders cannot be synchronized. LOCK_ERROR: with this error nothing can be locked.
// READ_ONLY_LOCK_ERROR: with this error nothing can be locked that is opened for reading alone. OTHER_LOCK_FILE: if
// set, files called "lock" are other ones than those that were opened by this name.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>
#include <string_view>

namespace {

/// Sets errno if a variable names an error.
bool fails_by(const char* variable) {
  const char* error = std::getenv(variable);
  if (error != nullptr) errno = std::atoi(error);
  return error != nullptr;
}

template <class Function>
Function* next(const char* name, Function&) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

extern "C" int fsync(int descriptor) {
  struct stat status {};
  if (fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode) && fails_by("FOLDER_SYNC_ERROR")) return -1;
  return next("fsync", fsync)(descriptor);
}

extern "C" int stat(const char* path, struct stat* status) {
  const int result = next("stat", stat)(path, status);
  if (std::getenv("OTHER_LOCK_FILE") != nullptr && std::string_view(path).ends_with("/lock")) ++status->st_ino;
  return result;
}

extern "C" int flock(int descriptor, int operation) {
  if (fails_by("LOCK_ERROR")) return -1;
  const bool is_read_only = (fcntl(descriptor, F_GETFL) & O_ACCMODE) == O_RDONLY;
  if (is_read_only && fails_by("READ_ONLY_LOCK_ERROR")) return -1;
  return next("flock", flock)(descriptor, operation);
}
