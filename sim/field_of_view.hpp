#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/problem.hpp"
#include "core/stream.hpp"

namespace ridgeloc::sim {

/// How far away the objects are.
enum class DepthDistribution {
  Uniform,  ///< uniform in depth
  Volume,   ///< uniform in space: density proportional to depth squared
};
inline constexpr std::array<std::string_view, 2> depth_distribution_names = {"uniform", "volume"};

/// A camera at the origin looking along +x (y to the left, z up) and objects in its field of view.
///
/// Object j lies at depth d, the distance from the camera, in the direction
/// (cos el cos az, cos el sin az, sin el), with azimuth and elevation uniform in their intervals.
struct FieldOfView {
  std::array<double, 2> azimuth_deg{-60.0, 60.0};
  std::array<double, 2> elevation_deg{-80.0, 80.0};
  std::array<double, 2> depth_m{1.0, 10.0};
  DepthDistribution depth_distribution = DepthDistribution::Uniform;
  double start_offset_m = 5.0;  ///< the start lies at exactly this distance from the truth, in a random direction

  /// Canonical text of what the stream of object positions depends on.
  std::string scene_content() const;
};

/// Streams that scenes are drawn from. The scene depends on the field of view, the direction of the start on nothing;
/// neither depends on the number of points, so that three points are the first three of seven.
struct SceneStreams {
  SceneStreams(std::uint64_t seed, const FieldOfView& view);
  core::Stream scene;
  core::Stream start;
};

/// Where the camera truly is: the origin of the map frame.
inline constexpr std::array<double, 3> true_position_m = {0.0, 0.0, 0.0};

/// Writes points and start of trials first_trial, first_trial + 1, ... into the lanes of `problems`, which is shaped.
void place_objects(const FieldOfView& view, const SceneStreams& streams, std::uint64_t first_trial,
                   core::ProblemBatch& problems);

}  // namespace ridgeloc::sim
