#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/stream.hpp"
#include "sim/building_map.hpp"
#include "sim/camera.hpp"
#include "sim/detector.hpp"

namespace ridgeloc::sim {

/// How photos are taken, and which of them count.
struct PhotoOptions {
  Camera camera;
  double height_m = 1.5;         ///< of the camera above the floor
  double wall_distance_m = 0.3;  ///< a camera is no nearer to the border of its area
  double pitch_sigma_deg = 0.0;  ///< standard deviations of the tilt
  double roll_sigma_deg = 0.0;
  std::size_t least_visible = 3;     ///< photos that show fewer objects are not taken
  double widest_spread_deg = 180.0;  ///< nor do those count whose detections lie further apart, left to right
};

/// One photo and what is detected in it.
struct Photo {
  CameraPose pose;
  double image_distance_mm = 0.0;
  std::vector<View> views;            ///< what it shows
  std::vector<Detection> detections;  ///< in the order of the map's objects
  std::uint64_t attempts = 0;         ///< photos taken until one counted, this one included
};

/// Takes photos: in an area chosen by its size, uniformly off its border, in a uniform direction.
///
/// A trial takes photos until one counts; which one that is depends on the trial alone. Thread safe; map and options
/// must live as long.
class PhotoTaker {
 public:
  PhotoTaker(const BuildingMap& map, const PhotoOptions& options, const DetectorModel& detector, std::uint64_t seed);

  /// Writes the photo of a trial: one with so many detections, or any number where that is 0. Returns false, and an
  /// unspecified photo, if none of `most_attempts` counts.
  bool take(std::uint64_t trial, std::size_t detections, Photo& photo) const;

  /// Writes one photo of those that a trial takes, with what is detected in it. Returns false, and an unspecified
  /// photo, if it shows too little.
  bool take_one(std::uint64_t trial, std::uint64_t attempt, Photo& photo) const;

  /// Whether the detections of a photo lie no further apart than `widest_spread_deg`.
  bool is_narrow(const Photo& photo) const;

  static constexpr std::uint64_t most_attempts = 200'000;

 private:
  CameraPose draw_pose(std::uint64_t trial, std::uint64_t attempt) const;

  const BuildingMap& map_;
  const PhotoOptions& options_;
  const DetectorModel& detector_;
  core::Stream poses_;
  core::Stream errors_;
  std::vector<double> areas_m2_;  ///< where a camera may stand, summed up
};

/// A number of detections as in the RRR paper's Table 1: of 80 photos 47, 22, 7, 3 and 1 have 3, 4, 5, 6 and 7.
/// `u` is uniform on (0, 1).
std::size_t table1_detections(double u);

}  // namespace ridgeloc::sim
