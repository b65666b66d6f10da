#pragma once

#include <atomic>

namespace ridgeloc::app {

/// Lets SIGINT and SIGTERM ask for a stop instead of killing the program; another one, seconds later, kills it.
/// The flag becomes true when a signal has come.
const std::atomic<bool>& stop_on_signals();

}  // namespace ridgeloc::app
