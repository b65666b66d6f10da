#pragma once

#include <string>
#include <thread>

#include "studies/run/runner.hpp"

namespace ridgeloc::app {

/// Shows on standard error how far a run is: on a terminal a bar with rate and time left, redrawn ten times a second;
/// elsewhere (a log, TERM=dumb) a plain line every ten seconds. While the result is written it says so. The bar goes
/// when the object does.
class ProgressDisplay {
 public:
  /// `may_grow`: a stop rule may ask for more trials than are known yet.
  ProgressDisplay(std::string name, const studies::RunProgress& progress, bool may_grow);

 private:
  void print_line(std::string line) const;
  void show(const std::stop_token& stop, const std::string& name, const studies::RunProgress& progress,
            bool may_grow) const;

  bool terminal_;
  std::jthread thread_;  // last: it reads the members above
};

}  // namespace ridgeloc::app
