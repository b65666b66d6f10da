#pragma once

#include <stdlib.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>

namespace ridgeloc::tests {

/// A file in memory: fuzzers wait for no disk. It has a name of its own, since HDF5 opens nothing without one.
class MemoryFile {
 public:
  MemoryFile() {
    std::string name = "/dev/shm/ridgeloc_fuzz_XXXXXX";
    const int descriptor = ::mkstemp(name.data());
    if (descriptor < 0) __builtin_trap();
    ::close(descriptor);
    path_ = name;
  }
  ~MemoryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  /// Replaces the content.
  void write(std::span<const char> content, std::string_view ending = {}) const {
    std::ofstream file(path_, std::ios::binary | std::ios::trunc);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    file << ending;
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace ridgeloc::tests
