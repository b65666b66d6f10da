#include "sim/range_noise.hpp"

#include <array>
#include <cmath>

#include "sim/field_of_view.hpp"
#include "sim/normal_noise.hpp"

namespace ridgeloc::sim {

std::span<const NoiseEntry> noise_registry() {
  static constexpr std::array<NoiseEntry, 1> registry = {{
      {"normal", "independent normal errors", draw_normal_noise},
  }};
  return registry;
}

void measure_ranges(const NoiseEntry& noise, double sigma_m, const core::Stream& stream, std::uint64_t first_trial,
                    core::ProblemBatch& problems) {
  noise.draw(stream, first_trial, problems);
  for (std::size_t j = 0; j < problems.points(); ++j) {
    const std::span<double> measured = problems.measured(j);
    const auto px = problems.position(j, 0);
    const auto py = problems.position(j, 1);
    const auto pz = problems.position(j, 2);
    for (std::size_t trial = 0; trial < problems.trials(); ++trial) {
      const double dx = px[trial] - true_position_m[0];
      const double dy = py[trial] - true_position_m[1];
      const double dz = pz[trial] - true_position_m[2];
      measured[trial] = std::sqrt(dx * dx + dy * dy + dz * dz) + sigma_m * measured[trial];
    }
  }
}

}  // namespace ridgeloc::sim
