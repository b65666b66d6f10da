#pragma once

#include <string>

#include "results/store/snapshot.hpp"

namespace ridgeloc::app {

/// Reads what there is of a result, sealed or not, after a child process has survived the same (`probe`). Says on
/// standard error if the run has not come to its end.
results::Snapshot look(const std::string& result);

}  // namespace ridgeloc::app
