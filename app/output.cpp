#include "app/output.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <iostream>
#include <system_error>

#include "core/error.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::app {

namespace fs = std::filesystem;

fs::path link_target(const fs::path& path) {
  constexpr int most_links = 40;  // the system's own limit
  fs::path target = path;
  std::error_code unknown;
  for (int i = 0; i < most_links && fs::is_symlink(target, unknown); ++i)
    target = target.parent_path() / fs::read_symlink(target, unknown);
  return target;
}

void write_output(const std::string& path, const std::function<void(std::ostream&)>& write) {
  if (path.empty()) {
    write(std::cout);
    return;
  }
  std::error_code unknown;
  const fs::path target = link_target(path);
  const auto fill = [&](const fs::path& file) {
    std::ofstream out(file, std::ios::binary);
    write(out);
    out.close();
    if (!out) throw core::IoError(path + ": writing failed; is the disk full?");
  };
  if (fs::exists(target, unknown) && fs::is_other(target, unknown)) {
    fill(target);
    return;
  }
  results::refuse_to_replace_result(target);
  results::require_writable(target);
  results::TemporaryFile file(target);
  fill(file.path());
  file.publish();
}

void require_folder(const fs::path& folder) {
  std::error_code failure;
  if (folder.empty() || fs::is_directory(folder, failure)) return;
  fs::create_directory(folder, failure);
  if (failure) {
    throw core::InputError(
        fmt::format("{}: this folder cannot be made ({}); choose another -o", folder.string(), failure.message()));
  }
}

bool path_exists(const fs::path& path) {
  std::error_code unknown;
  return fs::exists(path, unknown);
}

void finish_standard_output() {
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  if (!std::cout || !flushed || std::ferror(stdout) != 0) {
    throw core::IoError("standard output cannot be written; is the disk full or the reader gone?");
  }
}

}  // namespace ridgeloc::app
