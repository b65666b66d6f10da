#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

#include "core/problem.hpp"

namespace ridgeloc::tests {

using Position = std::array<double, core::position_parameters>;

/// One problem with its truth: points 1 to 10 m in front of the camera, spread like a field of view, scores
/// 0.5 to 1.
struct Scene {
  core::ProblemBatch batch;
  Position truth{0.3, -0.2, 1.5};
  Position start{3.3, 2.8, -0.5};
};

inline Scene make_scene(std::size_t points, double sigma_m, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const auto uniform = [&engine](double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(engine() >> 11), -53);
  };
  Scene scene;
  scene.batch.reshape(points, 1);
  scene.batch.add_scores();
  for (std::size_t j = 0; j < points; ++j) {
    const double depth = uniform(1.0, 10.0);
    const Position offset{depth, depth * uniform(-1.7, 1.7), depth * uniform(-2.0, 2.0)};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scene.batch.position(j, axis)[0] = scene.truth[axis] + offset[axis];
    }
    // Uniform noise of standard deviation sigma.
    const double noise = sigma_m * uniform(-std::sqrt(3.0), std::sqrt(3.0));
    scene.batch.measured(j)[0] = std::hypot(offset[0], offset[1], offset[2]) + noise;
    scene.batch.score(j)[0] = uniform(0.5, 1.0);
  }
  return scene;
}

}  // namespace ridgeloc::tests
