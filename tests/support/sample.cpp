#include "tests/support/sample.hpp"

#include <cmath>
#include <numbers>

namespace ridgeloc::tests {

double uniform(std::mt19937_64& engine, double low, double high) {
  return low + (high - low) * std::ldexp(static_cast<double>(engine() >> 11), -53);
}

double normal(std::mt19937_64& engine) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(engine, 0.0, 1.0)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(engine, 0.0, 1.0));
}

Sample random_sample(std::mt19937_64& engine, const SampleShape& shape) {
  Sample sample;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sample.truth[axis] = uniform(engine, -2.0, 2.0);
    sample.start[axis] = sample.truth[axis] + uniform(engine, -shape.offset_m, shape.offset_m);
  }
  sample.start_image_distance = sample.image_distance * (1.0 + 0.01 * uniform(engine, -1.0, 1.0));
  for (std::size_t j = 0; j < shape.points; ++j) {
    Point direction{normal(engine), normal(engine), normal(engine)};
    const double range = uniform(engine, 1.0, 10.0);
    const double length = std::hypot(direction[0], direction[1], direction[2]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      direction[axis] = sample.truth[axis] + range * direction[axis] / length;
    sample.points.push_back(direction);
    const double measured = std::max(0.1, range + shape.sigma_m * normal(engine));
    if (shape.images) {
      // Of the measured range, seen l mm beside the optical centre: r^2 = alpha (v^2 + l^2), rho = alpha l^2.
      const double beside = uniform(engine, 0.0, 3.0);
      const double v = sample.image_distance;
      sample.alpha.push_back(measured * measured / (v * v + beside * beside));
      sample.measured.push_back(sample.alpha.back() * beside * beside);
    } else {
      sample.measured.push_back(measured);
    }
    if (shape.scores) sample.score.push_back(uniform(engine, 0.3, 1.0));
  }
  return sample;
}

core::ProblemBatch batch_of(const std::vector<Sample>& samples) {
  core::ProblemBatch batch;
  batch.reshape(samples[0].points.size(), samples.size());
  if (!samples[0].score.empty()) batch.add_scores();
  if (samples[0].has_images()) batch.add_images();
  for (std::size_t t = 0; t < samples.size(); ++t) {
    const Sample& sample = samples[t];
    for (std::size_t j = 0; j < sample.points.size(); ++j) {
      for (std::size_t axis = 0; axis < 3; ++axis) batch.position(j, axis)[t] = sample.points[j][axis];
      batch.measured(j)[t] = sample.measured[j];
      if (batch.has_scores()) batch.score(j)[t] = sample.score[j];
      if (batch.has_images()) batch.alpha(j)[t] = sample.alpha[j];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) batch.start(axis)[t] = sample.start[axis];
    if (batch.has_images()) batch.start_image_distance()[t] = sample.start_image_distance;
  }
  return batch;
}

}  // namespace ridgeloc::tests
