#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "core/problem.hpp"

namespace ridgeloc::tests {

inline constexpr double true_distance_mm = 4.15;
inline std::array<double, 3> pseudorange_truth() {
  return {0.3, -0.2, 1.5};
}

/// Pseudoranges to points 1 to 10 m in front of a camera at `pseudorange_truth`, whose ranges have uniform errors of
/// standard deviation sigma_m; scores 0.5 to 1. The start is right in height, 0.2 % wrong in v and up to 1 m elsewhere.
inline core::ProblemBatch pseudorange_scenes(std::size_t points, std::size_t trials, double sigma_m,
                                             std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&engine](double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine() >> 11), -53);
  };
  const std::array<double, 3> truth = pseudorange_truth();
  core::ProblemBatch batch;
  batch.reshape(points, trials);
  batch.add_scores();
  batch.add_images();
  for (std::size_t t = 0; t < trials; ++t) {
    for (std::size_t j = 0; j < points; ++j) {
      const double depth = uniform(1.0, 10.0);
      const std::array<double, 3> offset{depth, depth * uniform(-1.5, 1.5), depth * uniform(-1.0, 1.0)};
      for (std::size_t axis = 0; axis < 3; ++axis) batch.position(j, axis)[t] = truth[axis] + offset[axis];
      const double noise = sigma_m * uniform(-std::sqrt(3.0), std::sqrt(3.0));
      const double range = std::hypot(offset[0], offset[1], offset[2]) + noise;
      const double from_centre_mm = uniform(0.0, 2.5);
      const double alpha = range * range / (true_distance_mm * true_distance_mm + from_centre_mm * from_centre_mm);
      batch.alpha(j)[t] = alpha;
      batch.measured(j)[t] = alpha * from_centre_mm * from_centre_mm;
      batch.score(j)[t] = uniform(0.5, 1.0);
    }
    batch.start(0)[t] = truth[0] + uniform(-1.0, 1.0);
    batch.start(1)[t] = truth[1] + uniform(-1.0, 1.0);
    batch.start(2)[t] = truth[2];
    batch.start_image_distance()[t] = 1.002 * true_distance_mm;
  }
  return batch;
}

}  // namespace ridgeloc::tests
