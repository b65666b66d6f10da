#include "app/interrupt.hpp"

#include <csignal>
#include <ctime>

namespace ridgeloc::app {

namespace {

/// Senders such as timeout(1) and batch systems signal the process and its group: what comes within a second of the
/// first signal is the same request.
constexpr std::time_t same_request_s = 1;

std::atomic<bool> stop_requested{false};
std::atomic<std::time_t> first_signal_s{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::time_t>::is_always_lock_free,
              "a signal handler may use them");

void request_stop(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  if (!stop_requested.exchange(true)) {
    first_signal_s.store(now.tv_sec);
  } else if (now.tv_sec - first_signal_s.load() > same_request_s) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

const std::atomic<bool>& stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = request_stop;
  action.sa_flags = SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  return stop_requested;
}

}  // namespace ridgeloc::app
