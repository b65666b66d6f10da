#include "app/result_probe.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "core/error.hpp"

namespace ridgeloc::app {

namespace {

/// Reading a result takes less than 4 times its size in memory, and a second for 15 MB of well compressed counts.
constexpr std::uintmax_t least_memory = std::uintmax_t{1} << 30;
constexpr std::uintmax_t memory_per_byte = 16;
constexpr std::uintmax_t least_seconds = 2;
constexpr std::uintmax_t bytes_per_second = std::uintmax_t{1} << 20;

void limit(auto resource, std::uintmax_t value) {
  rlimit now{};
  getrlimit(resource, &now);
  const rlim_t lower = std::min<rlim_t>(now.rlim_max, value);
  const rlimit wanted{lower, lower};
  setrlimit(resource, &wanted);
}

/// Address space in use, in bytes; 0 if the system does not tell.
std::uintmax_t present_memory() {
  std::uintmax_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE));
}

void limit_this_process(const std::string& result) {
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(result, unknown);
  const std::uintmax_t bytes = unknown ? 0 : size;
  const std::uintmax_t present = present_memory();
  if (present > 0) limit(RLIMIT_AS, present + std::max(least_memory, memory_per_byte * bytes));
  limit(RLIMIT_CPU, least_seconds + bytes / bytes_per_second);
  limit(RLIMIT_CORE, 0);
  // What the C library says of a broken heap is no line for the user.
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDERR_FILENO);
}

bool survives(const std::function<void()>& read) {
  try {
    read();
  } catch (const core::InputError&) {
    return true;
  } catch (const core::IoError&) {
    return true;
  } catch (...) {
    return false;
  }
  return true;
}

}  // namespace

void probe(const std::string& result, const std::function<void()>& read) {
  std::signal(SIGCHLD, SIG_DFL);  // were it ignored, as some parents leave it, the child's end could not be learned
  const pid_t child = fork();
  if (child < 0) {
    throw core::IoError(
        fmt::format("{}: no process can be started to read it: {}", result, std::generic_category().message(errno)));
  }
  if (child == 0) {
    limit_this_process(result);
    _exit(survives(read) ? 0 : 1);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    throw core::InputError(
        fmt::format("{} is damaged: reading it fails; compute it again or restore it from a copy", result));
  }
}

}  // namespace ridgeloc::app
