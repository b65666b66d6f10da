#pragma once

#include <string>
#include <thread>

#include "studies/run/runner.hpp"

namespace ridgeloc::app {

/// How far a run is after some time: a bar for terminals, or a line for logs. `may_grow`: a stop rule may ask for more
/// trials than are known yet, so that all of these being done does not mean that the result is being written.
std::string progress_text(const std::string& name, const studies::RunProgress& progress, bool may_grow, double seconds,
                          bool is_terminal);

/// Shows on standard error how far a run is: on a terminal a bar with rate and time left, redrawn ten times a second;
/// elsewhere (a log, TERM=dumb) a plain line every ten seconds. While the result is written it says so. The bar goes
/// when the object does.
class ProgressDisplay {
 public:
  /// `may_grow`: as for `progress_text`.
  ProgressDisplay(std::string name, const studies::RunProgress& progress, bool may_grow);

 private:
  void print_line(std::string line) const;
  void show(const std::stop_token& stop, const std::string& name, const studies::RunProgress& progress,
            bool may_grow) const;

  bool terminal_;
  std::jthread thread_;  // last: it reads the members above
};

}  // namespace ridgeloc::app
