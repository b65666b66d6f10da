#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "sim/kernels.hpp"

namespace ridgeloc::tests {

inline constexpr std::array<double, 5> noise_samples = {-2.0, 0.25, 0.5, 1.0, 3.0};

/// Options with samples to draw from; their root mean square is sqrt(14.3125 / 5).
inline sim::NoiseOptions noise_options(double range_sigma_m = 1.0) {
  sim::NoiseOptions options;
  options.range_sigma_m = range_sigma_m;
  options.samples = noise_samples;
  options.samples_rms = 1.6918924315687864;
  return options;
}

/// The kernels as templates over double.
inline sim::Kernels double_path() {
  return sim::kernels_over<double>();
}

/// Which trials of what to draw.
struct Draw {
  std::size_t points = 7;
  std::size_t trials = 50'000;
  std::uint64_t first = 0;
  bool scored = false;
  double range_m = 0.0;  ///< of every point
};

/// Measured ranges of points that all lie at one distance, drawn with a model.
inline core::ProblemBatch draw_ranges(std::string_view model, const sim::NoiseOptions& options, const Draw& draw,
                                      const sim::Kernels& kernels = double_path()) {
  core::ProblemBatch problems;
  problems.reshape(draw.points, draw.trials);
  for (std::size_t j = 0; j < draw.points; ++j) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::ranges::fill(problems.position(j, axis), axis == j % 3 ? draw.range_m : 0.0);
    }
  }
  if (draw.scored) {
    problems.add_scores();
    kernels.draw_scores(options.score, core::Stream(2018, "score"), draw.first, problems);
  }
  kernels.measure_ranges(*sim::find_noise(model), options, core::Stream(2018, "noise", model), draw.first, problems);
  return problems;
}

/// The same, one number per observation: points one after the other.
inline std::vector<double> draw_errors(std::string_view model, const sim::NoiseOptions& options,
                                       const Draw& draw = {}) {
  const core::ProblemBatch problems = draw_ranges(model, options, draw);
  std::vector<double> errors;
  for (std::size_t j = 0; j < draw.points; ++j) {
    const auto column = problems.measured(j);
    errors.insert(errors.end(), column.begin(), column.end());
  }
  return errors;
}

}  // namespace ridgeloc::tests
