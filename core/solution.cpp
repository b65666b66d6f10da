#include "core/solution.hpp"

namespace ridgeloc::core {

void SolutionBatch::reshape(std::size_t trials) {
  for (auto& coordinate : estimate) coordinate.resize(trials);
  for (auto* column :
       {&image_distance_mm, &iterations, &residual_rms_m, &remaining_step_m, &eta_first, &eta_last, &eta_mean}) {
    column->resize(trials);
  }
  status.assign(trials, static_cast<std::uint8_t>(Status::NotRun));
}

}  // namespace ridgeloc::core
