#pragma once

#include <string>

namespace ridgeloc::app {

/// A time in the unit that reads best: "0.42 s", "12 s", "3 min 20 s", "2 h 5 min".
std::string duration_text(double seconds);

}  // namespace ridgeloc::app
