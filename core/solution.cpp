#include "core/solution.hpp"

namespace ridgeloc::core {

void SolutionBatch::reshape(std::size_t trials) {
  for (auto& coordinate : estimate) coordinate.resize(trials);
  for (auto* column : {&iterations, &residual_rms_m, &remaining_step_m, &eta_first, &eta_last, &eta_mean}) {
    column->resize(trials);
  }
  status.assign(trials, static_cast<std::uint8_t>(Status::NotRun));
}

void SolutionBatch::copy_trial(const SolutionBatch& from, std::size_t trial, std::size_t slot) {
  for (std::size_t axis = 0; axis < position_parameters; ++axis) estimate[axis][slot] = from.estimate[axis][trial];
  status[slot] = from.status[trial];
  iterations[slot] = from.iterations[trial];
  residual_rms_m[slot] = from.residual_rms_m[trial];
  remaining_step_m[slot] = from.remaining_step_m[trial];
  eta_first[slot] = from.eta_first[trial];
  eta_last[slot] = from.eta_last[trial];
  eta_mean[slot] = from.eta_mean[trial];
}

}  // namespace ridgeloc::core
