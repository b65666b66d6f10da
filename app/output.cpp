#include "app/output.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <system_error>

#include "core/error.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::app {

namespace fs = std::filesystem;

void prepare_standard_streams() {
  std::signal(SIGPIPE, SIG_IGN);
  // The lowest free descriptor is taken. Opened for reading alone, none pretends to take what is written to it.
  for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(descriptor, F_GETFD) < 0 && errno == EBADF) static_cast<void>(::open("/dev/null", O_RDONLY));
}

void say(std::string_view text) noexcept {
  while (!text.empty()) {
    const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

fs::path link_target(const fs::path& path) {
  constexpr int most_links = 40;  // the system's own limit
  fs::path target = path;
  std::error_code unknown;
  for (int i = 0; i < most_links && fs::is_symlink(target, unknown); ++i)
    target = target.parent_path() / fs::read_symlink(target, unknown);
  if (fs::is_symlink(target, unknown))
    throw core::InputError(
        fmt::format("{}: these links lead in a circle; remove them or choose another -o", path.string()));
  return target;
}

void write_output(const std::string& path, const std::function<void(std::ostream&)>& write) {
  if (path.empty()) {
    try {
      write(std::cout);
    } catch (const core::IoError&) {
      if (!std::cout) throw OutputLost();
      throw;
    }
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

bool is_reader_gone() {
  pollfd output{STDOUT_FILENO, 0, 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0;
}

void finish_standard_output() {
  std::cout.flush();
  const bool flushed = std::fflush(stdout) == 0;
  if (!std::cout || !flushed || std::ferror(stdout) != 0) {
    throw OutputLost();
  }
}

}  // namespace ridgeloc::app
