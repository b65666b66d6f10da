#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/contains.hpp"
#include "tests/support/scratch_folder.hpp"

namespace ridgeloc::tests {

/// What a call of the program printed and how it ended.
struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string error;
};

/// A folder of its own for each test, in which the program runs; removed at the end.
class WorkingFolder {
 public:
  /// Runs `ridgeloc ARGUMENTS` through the shell, in this folder.
  Outcome ridgeloc(const std::string& arguments) const;
  /// Runs any shell command in this folder.
  Outcome shell(const std::string& command) const;

  void write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;
  bool has(const std::string& name) const;
  /// Names of all files and folders in here, sorted.
  std::vector<std::string> entries() const;
  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  ScratchFolder folder_;
};

/// A folder with a study in it, s.toml.
struct WithStudy : WorkingFolder {
  explicit WithStudy(const std::string& toml) { write("s.toml", toml); }
};

std::size_t line_count(const std::string& text);

}  // namespace ridgeloc::tests
