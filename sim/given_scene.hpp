#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/problem.hpp"
#include "core/random.hpp"
#include "sim/start_direction.hpp"

namespace ridgeloc::sim {

/// Positions (m), a column for each coordinate, all of one length.
using PositionColumns = std::array<std::span<const double>, core::position_parameters>;

/// Objects at given places in the frame of a map, and a camera at one of some given places, each as likely as the
/// others, or anywhere in a box, uniform. Refers to what it is made of.
struct GivenScene {
  PositionColumns objects;
  PositionColumns cameras;                                               ///< none: in the box
  std::array<std::array<double, 2>, core::position_parameters> box_m{};  ///< from and to, by coordinate
  double start_offset_m = 5.0;   ///< the start lies at exactly this distance from the truth, in a random direction
  bool start_at_height = false;  ///< ... and at the true height
};

/// Streams that these scenes are drawn from. Neither depends on any setting: other places are drawn by the same
/// numbers.
struct GivenSceneStreams {
  explicit GivenSceneStreams(std::uint64_t seed) : camera(seed, "camera"), start(seed, "start") {}
  core::Stream camera;
  core::Stream start;
};

/// Where the camera truly is (m), by coordinate and trial.
using TruthColumns = std::array<std::span<double>, core::position_parameters>;

/// Writes where the camera is in trials first_trial, first_trial + 1, ..., and the objects as they lie from there, so
/// that noise and scores are those of a camera at the origin; `show_map` tells the problems in the frame of the map.
/// Precondition: `problems` has a point for each of the first objects, `truth` room for each trial.
template <class Real = double>
[[gnu::flatten]] void place_camera(const GivenScene& scene, const GivenSceneStreams& streams, std::uint64_t first_trial,
                                   const TruthColumns& truth, core::ProblemBatch& problems) {
  using Words = core::Words<Real>;
  const std::size_t cameras = scene.cameras[0].size();
  for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
    const Words trial = core::trial_words<Real>(first_trial + slot);
    const auto u = core::uniform_triple<Real>(streams.camera.block(trial, Words(0U)));
    for (std::size_t axis = 0; axis < core::position_parameters; ++axis) {
      const auto& [low, high] = scene.box_m[axis];
      // u < 1 keeps u n below n: the largest u, 1 - 2^-43, lies more than a step of n below it.
      const Real camera = cameras > 0
                              ? core::look_up(scene.cameras[axis].data(), u[0] * Real(static_cast<double>(cameras)))
                              : core::mul_add(Real(high - low), u[axis], Real(low));
      core::store_column(truth[axis], slot, camera);
      for (std::size_t j = 0; j < problems.points(); ++j)
        core::store_column(problems.position(j, axis), slot, Real(scene.objects[axis][j]) - camera);
    }
  }
}

/// Puts the objects where the map has them, and the start beside the camera.
template <class Real = double>
[[gnu::flatten]] void show_map(const GivenScene& scene, const GivenSceneStreams& streams, std::uint64_t first_trial,
                               const TruthColumns& truth, core::ProblemBatch& problems) {
  using Words = core::Words<Real>;
  for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
    const Words trial = core::trial_words<Real>(first_trial + slot);
    const auto u = core::uniform_pair<Real>(streams.start.block(trial, Words(0U)));
    const std::array<Real, 3> offset = start_direction<Real>(scene.start_at_height, u);
    for (std::size_t axis = 0; axis < core::position_parameters; ++axis) {
      for (std::size_t j = 0; j < problems.points(); ++j)
        core::store_column(problems.position(j, axis), slot, Real(scene.objects[axis][j]));
      const Real camera = core::load_column<Real>(std::span<const double>(truth[axis]), slot);
      core::store_column(problems.start(axis), slot, core::mul_add(Real(scene.start_offset_m), offset[axis], camera));
    }
  }
}

}  // namespace ridgeloc::sim
