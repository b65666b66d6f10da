#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/stream.hpp"
#include "sim/building_map.hpp"
#include "sim/camera.hpp"

namespace ridgeloc::sim {

/// How well a detector of objects works. Shares of box sizes are relative errors.
struct DetectorModel {
  double recall_near = 0.745;  ///< how often it finds an object near by, where its class does not say otherwise
  double recall_far = 0.375;
  double near_m = 10.0;        ///< up to here is near
  double edge_sigma = 0.06;    ///< standard deviation of each edge of a box, as a share of the box' size across it
  double outlier_rate = 0.10;  ///< share of boxes with one edge, upper or lower, far off
  std::array<double, 2> outlier_size = {0.15, 0.40};  ///< by how much of the height, uniform, inwards or outwards
  double centre_sigma = 0.0;      ///< of the centre of a box beside what its edges make, as a share of its size
  double height_sigma = 0.0;      ///< of the object's height in the map, as a share of it
  double false_class_rate = 0.0;  ///< share of detections that take the object for one of another class
  double score_low = 0.2;         ///< scores lie between this and 1
  /// How often a score tells of the error of its box' height, the smaller the error the higher; the others tell
  /// nothing.
  double score_link = 0.0;
};

/// What a detector says of one object of a picture.
struct Detection {
  std::size_t object = 0;  ///< truly; index into `BuildingMap::objects`
  std::size_t object_class = 0;
  Box box;
  double score = 1.0;
  double height_factor = 1.0;  ///< height in the map by true height
};

/// The stream of a detector's errors. Those of an object depend on seed, trial, attempt and the object's number alone,
/// so that what else a picture shows, and how good the detector is, changes none of them.
core::Stream detector_stream(std::uint64_t seed);

/// Whether and how an object in a picture is detected. `attempt` tells pictures of one trial apart.
///
/// A box' edges are off by normal errors of `edge_sigma` each, and with `outlier_rate` its upper or lower edge by a
/// share of its height, uniform in `outlier_size`, to either side. Thread safe.
std::optional<Detection> detect(const DetectorModel& model, const BuildingMap& map, const View& view,
                                const core::Stream& stream, std::uint64_t trial, std::uint64_t attempt);

/// What a detection says of |p - x|^2 = alpha v^2 + rho (RRR paper, eqs. 1, 2): alpha = (h c D / n)^2 (m^2 / mm^2) and
/// rho = alpha l^2 (m^2), h the object's height in the map (m), n the box' height (px), c D pixels per mm, l the
/// distance of its centre from the optical centre (mm).
struct Pseudorange {
  double alpha = 0.0;
  double rho = 0.0;

  /// sqrt(alpha v^2 + rho)
  double range_m(double image_distance_mm) const;
};
Pseudorange pseudorange(const Camera& camera, const Box& box, double height_m);
/// Of a detection that is taken for an object of the map.
Pseudorange pseudorange(const Camera& camera, const Detection& detection, const MapObject& taken_for);

}  // namespace ridgeloc::sim
