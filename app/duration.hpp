#pragma once

#include <string>

namespace ridgeloc::app {

/// A time in the unit that reads best: "0.42 s", "12 s", "3 min 20 s", "2 h 5 min", "9.5 days", "2076 years".
std::string duration_text(double seconds);

/// "1.25 M trials/s", "3.1 k trials/s", "0.42 trials/s".
std::string rate_text(double trials_per_second);

/// Seconds of a time as people and batch systems write it: "90", "90s", "10m", "1h30m", "2d", "MM:SS", "HH:MM:SS",
/// "D-HH:MM:SS". Throws core::InputError for anything else, and for 0.
double seconds_of(const std::string& text);

}  // namespace ridgeloc::app
