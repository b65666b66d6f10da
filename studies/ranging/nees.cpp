#include "studies/ranging/nees.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace ridgeloc::studies {

void normalized_squared_errors(const core::ProblemBatch& problems,
                               const std::array<std::span<const double>, core::position_parameters>& estimate,
                               const std::array<std::span<const double>, core::position_parameters>& truth_m,
                               double sigma_m, std::span<double> nees) {
  std::ranges::fill(nees, 0.0);
  for (std::size_t j = 0; j < problems.points(); ++j) {
    const std::span<const double> x = problems.position(j, 0);
    const std::span<const double> y = problems.position(j, 1);
    const std::span<const double> z = problems.position(j, 2);
    for (std::size_t t = 0; t < nees.size(); ++t) {
      const std::array<double, 3> to_object = {x[t] - estimate[0][t], y[t] - estimate[1][t], z[t] - estimate[2][t]};
      double along = 0.0;
      double squared_range = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        along += to_object[axis] * (estimate[axis][t] - truth_m[axis][t]);
        squared_range += to_object[axis] * to_object[axis];
      }
      nees[t] += along * along / squared_range;
    }
  }
  const double variance = sigma_m > 0.0 ? sigma_m * sigma_m : std::numeric_limits<double>::quiet_NaN();
  for (double& value : nees) value /= variance;
}

}  // namespace ridgeloc::studies
