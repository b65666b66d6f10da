#pragma once

namespace ridgeloc::app {

/// How the program ends; README.md explains them to users.
enum ExitCode : int {
  Success = 0,
  BadInput = 2,   ///< a study file, an option or a path that cannot be used
  IoFailure = 3,  ///< reading or writing failed during the work
  Stopped = 4,    ///< stopped by a signal; what was finished is kept
};

}  // namespace ridgeloc::app
