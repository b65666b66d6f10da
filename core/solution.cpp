#include "core/solution.hpp"

#include <limits>

namespace ridgeloc::core {

void SolutionBatch::reshape(std::size_t trials) {
  constexpr double not_run = std::numeric_limits<double>::quiet_NaN();
  for (auto& coordinate : estimate) coordinate.assign(trials, not_run);
  status.assign(trials, static_cast<std::uint8_t>(Status::NotRun));
  iterations.assign(trials, 0.0);
  for (auto* column : {&residual_rms_m, &remaining_step_m, &eta_first, &eta_last, &eta_mean}) {
    column->assign(trials, not_run);
  }
}

}  // namespace ridgeloc::core
