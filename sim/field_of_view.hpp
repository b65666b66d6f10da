#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/problem.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "sim/start_direction.hpp"

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
  double start_offset_m = 5.0;   ///< the start lies at exactly this distance from the truth, in a random direction
  bool start_at_height = false;  ///< ... and at the true height

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

namespace detail {

template <class Real>
Real interpolate(const std::array<double, 2>& interval, const Real& u) {
  return core::mul_add(Real(interval[1] - interval[0]), u, Real(interval[0]));
}

template <class Real>
Real depth(const FieldOfView& view, const Real& u) {
  if (view.depth_distribution == DepthDistribution::Uniform) return interpolate(view.depth_m, u);
  const auto cube = [](double d) { return d * d * d; };
  const Real volume = interpolate<Real>({cube(view.depth_m[0]), cube(view.depth_m[1])}, u);
  const Real inverse = core::inverse_cube_root(volume);
  return volume * inverse * inverse;
}

template <class Real>
core::SinCos<Real> direction(const std::array<double, 2>& interval_deg, const Real& u) {
  return core::sin_cos_turns(
      interpolate<Real>({interval_deg[0] * core::turns_per_degree, interval_deg[1] * core::turns_per_degree}, u));
}

}  // namespace detail

/// Writes points and start of trials first_trial, first_trial + 1, ... into `problems`, which is shaped.
template <class Real = double>
[[gnu::flatten]] void place_objects(const FieldOfView& view, const SceneStreams& streams, std::uint64_t first_trial,
                                    core::ProblemBatch& problems) {
  using Words = core::Words<Real>;
  for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
    const Words trial = core::trial_words<Real>(first_trial + slot);
    for (std::size_t j = 0; j < problems.points(); ++j) {
      const auto u = core::uniform_triple<Real>(streams.scene.block(trial, Words(j)));
      const core::SinCos<Real> azimuth = detail::direction(view.azimuth_deg, u[0]);
      const core::SinCos<Real> elevation = detail::direction(view.elevation_deg, u[1]);
      const Real d = detail::depth(view, u[2]);
      const Real horizontal = d * elevation.cos;
      core::store_column(problems.position(j, 0), slot, Real(true_position_m[0]) + horizontal * azimuth.cos);
      core::store_column(problems.position(j, 1), slot, Real(true_position_m[1]) + horizontal * azimuth.sin);
      core::store_column(problems.position(j, 2), slot, Real(true_position_m[2]) + d * elevation.sin);
    }
    const auto u = core::uniform_pair<Real>(streams.start.block(trial, Words(0U)));
    const std::array<Real, 3> offset = start_direction<Real>(view.start_at_height, u);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      core::store_column(problems.start(axis), slot,
                         core::mul_add(Real(view.start_offset_m), offset[axis], Real(true_position_m[axis])));
    }
  }
}

}  // namespace ridgeloc::sim
