#include "sim/normal_noise.hpp"

#include "core/random.hpp"

namespace ridgeloc::sim {

void draw_normal_noise(const core::Stream& noise, std::uint64_t first_trial, core::ProblemBatch& problems) {
  for (std::size_t j = 0; j < problems.points(); j += 2) {
    const auto even = problems.measured(j);
    const auto odd = j + 1 < problems.points() ? problems.measured(j + 1) : std::span<double>{};
    for (std::size_t trial = 0; trial < problems.trials(); ++trial) {
      const auto errors = core::normal_pair(core::uniform_pair(noise.block(first_trial + trial, j / 2)));
      even[trial] = errors[0];
      if (!odd.empty()) odd[trial] = errors[1];
    }
  }
}

}  // namespace ridgeloc::sim
