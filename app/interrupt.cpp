#include "app/interrupt.hpp"

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <mutex>

namespace ridgeloc::app {

namespace {

/// Senders such as timeout(1) and batch systems signal the process and its group: what comes within a second of the
/// first signal is the same request.
constexpr std::int64_t same_request_ns = 1'000'000'000;

std::atomic<bool> stop_requested{false};
std::atomic<std::int64_t> first_signal_ns{0};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free,
              "a signal handler may use them");

void request_stop(int signal) {
  timespec time{};
  clock_gettime(CLOCK_MONOTONIC, &time);
  const std::int64_t now = std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
  // Decides and stamps at once: the handler may run on two threads at the same time.
  std::int64_t first = 0;
  if (first_signal_ns.compare_exchange_strong(first, now)) {
    stop_requested.store(true);
  } else if (now - first > same_request_ns) {
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
  // Batch systems send this one some time before they kill a job.
  sigaction(SIGUSR1, &action, nullptr);
  // The terminal is gone. Under nohup the signal is ignored, and stays so.
  struct sigaction hangup {};
  if (sigaction(SIGHUP, nullptr, &hangup) == 0 && hangup.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  return stop_requested;
}

TimeLimit::TimeLimit(double seconds)
    : thread_([seconds](const std::stop_token& over) {
        std::mutex mutex;
        std::condition_variable_any wake;
        std::unique_lock lock(mutex);
        const bool ended =
            wake.wait_for(lock, over, std::chrono::duration<double>(seconds), [&] { return over.stop_requested(); });
        if (!ended) stop_requested.store(true);
      }) {}

}  // namespace ridgeloc::app
