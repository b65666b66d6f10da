#pragma once

namespace ridgeloc::app {

/// How the program ends; README.md explains them to users.
enum ExitCode : int {
  Success = 0,
  Different = 1,  ///< numbers that should be equal are not
  BadInput = 2,   ///< a study file, an option or a path that cannot be used
  IoFailure = 3,  ///< reading or writing failed during the work
  Stopped = 4,    ///< stopped by a signal or a time limit; what was finished is kept
};

}  // namespace ridgeloc::app
