#pragma once

#include <optional>
#include <span>

#include "sim/field_of_view.hpp"
#include "sim/given_scene.hpp"
#include "sim/noise_options.hpp"
#include "sim/range_noise.hpp"
#include "solvers/options.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::studies {

/// Settings of the `ranging` experiment: sections scene, noise and solver.
std::span<const Setting> ranging_settings();

/// What a cell says about scene and noise. Valid as long as the values.
struct RangingCell {
  explicit RangingCell(const Values& values);
  std::size_t points;
  sim::FieldOfView view;
  std::optional<sim::GivenScene> given;  ///< in place of `view`; refers to the positions among the values
  bool knows_height;
  const sim::NoiseEntry* noise;
  double range_sigma_m;             ///< a standard deviation
  sim::NoiseOptions noise_options;  ///< refers to the samples among the values
  bool has_scores;
  bool has_images;  ///< pseudoranges
  double focal_length_mm;
};

}  // namespace ridgeloc::studies
