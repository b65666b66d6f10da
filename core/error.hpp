#pragma once

#include <stdexcept>

namespace ridgeloc::core {

/// Something the user gave cannot be used: a study file, an option, an output path. The message is one line that says
/// what, where, what is allowed and how to fix it. The program prints it and exits with code 2.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reading or writing failed during the work: a full disk, a vanished folder, a damaged file. Exit code 3.
struct IoError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace ridgeloc::core
