#include "solvers/kernels/survivors.hpp"

namespace ridgeloc::solvers {

void Survivors::reshape(const core::ProblemBatch& batch, std::size_t values, std::size_t lanes) {
  values_ = values;
  next_ = 0;
  end_ = 0;
  if (trials_.size() < batch.trials()) trials_.resize(batch.trials());
  if (states_.size() < batch.trials() * values) states_.resize(batch.trials() * values);
  problems_.reshape(batch.points(), lanes);
  if (batch.has_scores()) problems_.add_scores();
  if (batch.has_images()) problems_.add_images();
  finished_.reshape(lanes);
}

double* Survivors::push(std::size_t trial) {
  trials_[end_] = static_cast<std::uint32_t>(trial);
  return states_.data() + values_ * end_++;
}

Survivors::Entry Survivors::pop(const core::ProblemBatch& batch, std::size_t slot) {
  const std::size_t taken = next_++;
  problems_.copy_trial(batch, trials_[taken], slot);
  return {trials_[taken], states_.data() + values_ * taken};
}

Survivors& survivors_of_thread() {
  thread_local Survivors survivors;
  return survivors;
}

}  // namespace ridgeloc::solvers
