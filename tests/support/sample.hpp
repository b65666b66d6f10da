#pragma once

#include <cstddef>
#include <random>
#include <vector>

#include "core/problem.hpp"
#include "tests/support/hand_scene.hpp"

namespace ridgeloc::tests {

/// One problem with its truth, ranges or pseudoranges.
struct Sample {
  std::vector<Point> points;
  std::vector<double> measured;  ///< ranges (m), or rho (m^2)
  std::vector<double> alpha;     ///< empty for ranges
  std::vector<double> score;     ///< empty: none
  Point truth{};
  Point start{};
  double image_distance = 4.15;        ///< true v (mm)
  double start_image_distance = 4.15;  ///< (mm)

  bool has_images() const { return !alpha.empty(); }
};

/// What a random sample is like.
struct SampleShape {
  std::size_t points = 5;
  bool images = false;
  bool scores = false;
  double sigma_m = 0.1;   ///< of the ranges, or of the ranges behind pseudoranges
  double offset_m = 1.0;  ///< of each coordinate of the start, at most
};

/// Points 1 to 10 m away in all directions, so that the geometry is mostly good.
Sample random_sample(std::mt19937_64& engine, const SampleShape& shape);

/// Uniform, and normal by Box and Muller: the same on every platform.
double uniform(std::mt19937_64& engine, double low, double high);
double normal(std::mt19937_64& engine);

/// Samples with the same number of points and the same columns as a batch.
core::ProblemBatch batch_of(const std::vector<Sample>& samples);

}  // namespace ridgeloc::tests
