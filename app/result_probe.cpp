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
#include <fstream>
#include <new>
#include <system_error>

#include "core/error.hpp"
#include "results/store/parts_folder.hpp"

namespace ridgeloc::app {

namespace {

/// Reading a result takes less than 4 times its size in memory, and a second for 15 MB of well compressed counts.
constexpr std::uintmax_t least_memory = std::uintmax_t{1} << 30;
constexpr std::uintmax_t memory_per_byte = 16;
constexpr std::uintmax_t least_seconds = 2;
constexpr std::uintmax_t bytes_per_second = std::uintmax_t{1} << 20;

/// How the child ends.
enum ChildCode : int { Survived = 0, Failed = 1, DamageTakesMemory = 2, TooLittleMemory = 3 };

/// Lowers a limit, where it is not lower already. Returns whether it was.
bool limit(auto resource, std::uintmax_t value) {
  rlimit now{};
  getrlimit(resource, &now);
  const rlim_t lower = std::min<rlim_t>({now.rlim_cur, now.rlim_max, value});
  const rlimit wanted{lower, lower};
  setrlimit(resource, &wanted);
  return lower < value;
}

/// Address space in use, in bytes; 0 if the system does not tell.
std::uintmax_t present_memory() {
  std::uintmax_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE));
}

/// Returns whether this process has less memory than a result of that size may need.
bool limit_this_process(std::uintmax_t bytes, unsigned patience_s) {
  const std::uintmax_t present = present_memory();
  const bool is_short =
      limit(RLIMIT_AS, (present > 0 ? present : least_memory) + std::max(least_memory, memory_per_byte * bytes));
  limit(RLIMIT_CPU, least_seconds + bytes / bytes_per_second);
  limit(RLIMIT_CORE, 0);
  // What takes no processor time can last for ever too: a disk that does not answer, or a pipe that nobody fills.
  std::signal(SIGALRM, SIG_DFL);
  alarm(patience_s);
  // What the C library says of a broken heap is no line for the user.
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDERR_FILENO);
  return is_short;
}

ChildCode outcome_of(const std::function<void()>& read, bool is_short_of_memory) {
  try {
    read();
  } catch (const core::InputError&) {
    return Survived;
  } catch (const core::IoError&) {
    return Survived;
  } catch (const std::bad_alloc&) {
    return is_short_of_memory ? TooLittleMemory : DamageTakesMemory;
  } catch (...) {
    return Failed;
  }
  return Survived;
}

}  // namespace

void probe(const std::string& result, const std::function<void()>& read, double patience) {
  std::signal(SIGCHLD, SIG_DFL);  // were it ignored, as some parents leave it, the child's end could not be learned
  const std::uintmax_t bytes = results::stored_bytes(result);
  const double seconds = patience * static_cast<double>(least_seconds + bytes / bytes_per_second);
  const auto patience_s = static_cast<unsigned>(std::clamp(seconds, 1.0, 1e6));
  const pid_t child = fork();
  if (child < 0) {
    throw core::IoError(
        fmt::format("{}: no process can be started to read it: {}", result, std::generic_category().message(errno)));
  }
  if (child == 0) {
    const bool is_short = limit_this_process(bytes, patience_s);
    _exit(outcome_of(read, is_short));
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == Survived) return;
  if (WIFEXITED(status) && WEXITSTATUS(status) == TooLittleMemory) {
    throw core::IoError(
        fmt::format("{}: there is too little memory to read it; raise the limit of this shell or job "
                    "(ulimit -v), or read it on a larger machine",
                    result));
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    throw core::IoError(fmt::format("{}: reading it has not ended within {} s; is its disk or network out of reach?",
                                    result, patience_s));
  }
  throw core::InputError(
      fmt::format("{} is damaged: reading it fails; compute it again or restore it from a copy", result));
}

}  // namespace ridgeloc::app
