#pragma once

#include <atomic>
#include <thread>

namespace ridgeloc::app {

/// Lets SIGINT, SIGTERM, SIGUSR1 and SIGHUP (unless nohup ignores it) ask for a stop instead of killing the program;
/// another one, seconds later, kills it. The flag becomes true when a signal has come.
const std::atomic<bool>& stop_on_signals();

/// Asks for a stop, as a signal does, when the time is over; not after the object is gone.
class TimeLimit {
 public:
  explicit TimeLimit(double seconds);

 private:
  std::jthread thread_;
};

}  // namespace ridgeloc::app
