// Loaded before the program (LD_PRELOAD): a file system that cannot synchronize folders, and says so by the error that
// the environment names.

#include <dlfcn.h>
#include <sys/stat.h>

#include <cerrno>
#include <cstdlib>

extern "C" int fsync(int descriptor) {
  struct stat status {};
  const char* error = std::getenv("FOLDER_SYNC_ERROR");
  if (error != nullptr && fstat(descriptor, &status) == 0 && S_ISDIR(status.st_mode)) {
    errno = std::atoi(error);
    return -1;
  }
  using Function = int (*)(int);
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, "fsync"))(descriptor);
}
