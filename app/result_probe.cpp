#include "app/result_probe.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <system_error>

#include "core/error.hpp"
#include "results/store/parts_folder.hpp"

namespace ridgeloc::app {

namespace {

/// Reading a result takes less than 4 times its size in memory, and a second for 15 MB of well compressed counts.
constexpr std::uintmax_t least_memory = std::uintmax_t{1} << 30;
constexpr std::uintmax_t memory_per_byte = 16;
constexpr std::uintmax_t least_seconds = 5;  // fresh memory alone takes seconds on a machine that is overloaded
constexpr std::uintmax_t bytes_per_second = std::uintmax_t{1} << 20;

/// Lowers a limit, where it is not lower already.
void limit(auto resource, std::uintmax_t value) {
  rlimit now{};
  getrlimit(resource, &now);
  const rlim_t lower = std::min<rlim_t>({now.rlim_cur, now.rlim_max, value});
  const rlimit wanted{lower, lower};
  setrlimit(resource, &wanted);
}

/// Address space in use, in bytes; 0 if the system does not tell.
std::uintmax_t present_memory() {
  std::uintmax_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uintmax_t>(sysconf(_SC_PAGESIZE));
}

/// Address space that a process may need that reads so many bytes.
std::uintmax_t memory_for(std::uintmax_t bytes) {
  return present_memory() + std::max(least_memory, memory_per_byte * bytes);
}

void limit_this_process(std::uintmax_t bytes, unsigned patience_s) {
  if (present_memory() > 0) limit(RLIMIT_AS, memory_for(bytes));
  limit(RLIMIT_CPU, least_seconds + bytes / bytes_per_second);
  limit(RLIMIT_CORE, 0);
  // What takes no processor time can last for ever too: a disk that does not answer, or a pipe that nobody fills.
  std::signal(SIGALRM, SIG_DFL);
  alarm(patience_s);
  // What the C library says of a broken heap is no line for the user.
  const int nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, STDERR_FILENO);
}

/// Locks that the parent holds last until this process has ended too.
void end_with(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);
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

/// Throws core::IoError if somebody has left this process less memory than a good file may need: then a reader that
/// failed says nothing of the file, since libraries crash for want of memory too.
void require_memory(const std::string& result, std::uintmax_t bytes) {
  rlimit memory{};
  getrlimit(RLIMIT_AS, &memory);
  if (memory.rlim_cur >= memory_for(bytes)) return;
  throw core::IoError(fmt::format(
      "{}: reading it fails, where no more than {} MiB of memory are allowed; raise that limit (ulimit -v) to {} MiB",
      result, memory.rlim_cur >> 20, (memory_for(bytes) >> 20) + 1));
}

}  // namespace

void probe(const std::string& result, const std::function<void()>& read, double patience) {
  std::signal(SIGCHLD, SIG_DFL);  // were it ignored, as some parents leave it, the child's end could not be learned
  const std::uintmax_t bytes = results::stored_bytes(result);
  const double seconds = patience * static_cast<double>(least_seconds + bytes / bytes_per_second);
  const auto patience_s = static_cast<unsigned>(std::clamp(seconds, 1.0, 1e6));
  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child < 0) {
    throw core::IoError(
        fmt::format("{}: no process can be started to read it: {}", result, std::generic_category().message(errno)));
  }
  if (child == 0) {
    end_with(parent);
    limit_this_process(bytes, patience_s);
    _exit(survives(read) ? 0 : 1);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM) {
    throw core::IoError(fmt::format("{}: reading it has not ended within {} s; is its disk or network out of reach?",
                                    result, patience_s));
  }
  require_memory(result, bytes);
  throw core::InputError(
      fmt::format("{} is damaged: reading it fails; compute it again or restore it from a copy", result));
}

}  // namespace ridgeloc::app
