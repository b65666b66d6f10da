#include "app/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <string_view>

#include "app/duration.hpp"
#include "app/output.hpp"
#include "core/elapsed.hpp"

namespace ridgeloc::app {

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto terminal_interval = std::chrono::milliseconds(100);
constexpr auto log_interval = std::chrono::seconds(10);
constexpr std::size_t bar_width = 24;

bool is_terminal() {
  const char* term = std::getenv("TERM");
  return isatty(STDERR_FILENO) == 1 && term != nullptr && std::string_view(term) != "dumb";
}

std::size_t terminal_columns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : 80;
}

}  // namespace

std::string progress_text(const std::string& name, const studies::RunProgress& progress, bool may_grow, double seconds,
                          bool is_terminal) {
  const auto run = static_cast<double>(progress.trials_done.load());
  const double done = run + static_cast<double>(progress.trials_found.load());
  const auto total = static_cast<double>(std::max<std::uint64_t>(progress.trials_total.load(), 1));
  // The last trials may be done while their part is still being written.
  if (progress.is_writing.load() || (!may_grow && done >= total))
    return fmt::format("{}: all trials are done, writing the result", name);
  const double share = std::min(done / total, 1.0);
  const double speed = run / seconds;
  const std::string left = speed > 0.0 ? duration_text(std::max(total - done, 0.0) / speed) : std::string("?");
  const std::string rate = rate_text(speed);
  if (!is_terminal) return fmt::format("{}: {:.1f} %, {}, {} left", name, share * 100.0, rate, left);
  const auto filled = static_cast<std::size_t>(share * bar_width);
  return fmt::format("{} {:3.0f}% [{}{}] {}, {} left", name, share * 100.0, std::string(filled, '#'),
                     std::string(bar_width - filled, '.'), rate, left);
}

ProgressDisplay::ProgressDisplay(std::string name, const studies::RunProgress& progress, bool may_grow)
    : terminal_(is_terminal()),
      thread_([this, name = std::move(name), &progress, may_grow](const std::stop_token& stop) {
        show(stop, name, progress, may_grow);
      }) {}

void ProgressDisplay::print_line(std::string line) const {
  if (!terminal_) return say(line + "\n");
  line.resize(std::min(line.size(), terminal_columns() - 1));
  say(fmt::format("\r{}\x1b[K", line));
}

void ProgressDisplay::show(const std::stop_token& stop, const std::string& name, const studies::RunProgress& progress,
                           bool may_grow) const {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);
  const Clock::time_point begin = Clock::now();
  while (!wake.wait_for(lock, stop, terminal_ ? Clock::duration(terminal_interval) : Clock::duration(log_interval),
                        [&] { return stop.stop_requested(); })) {
    print_line(progress_text(name, progress, may_grow, core::seconds_since(begin), terminal_));
  }
  if (terminal_) say("\r\x1b[K");
}

}  // namespace ridgeloc::app
