#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "sim/building_map.hpp"

namespace ridgeloc::sim {

/// A pinhole camera with a flat sensor; the rear camera of an iPhone 6 unless told otherwise (61.1 x 47.7 degrees).
struct Camera {
  double focal_length_mm = 4.15;
  double pixel_um = 1.5;
  double width_px = 3264.0;
  double height_px = 2448.0;
  double zoom = 1.0;  ///< digital: pixels of the picture for each pixel of the sensor

  double smallest_box_px = 20.0;  ///< lower boxes are too small to tell what they show
  double farthest_m = 13.5;       ///< nor is told what lies further away

  double pixels_per_mm() const { return zoom * 1000.0 / pixel_um; }

  /// v = f u / (u - f): distance of lens and sensor with the lens focused on what is u away (m), no nearer than 2 f.
  double image_distance_mm(double focus_m) const;

  friend bool operator==(const Camera&, const Camera&) = default;
};

/// Where a camera is and where it looks. Angles in turns: heading from +x towards +y; pitch up; roll to the right.
struct CameraPose {
  std::array<double, 3> position_m{};
  double heading_turns = 0.0;
  double pitch_turns = 0.0;
  double roll_turns = 0.0;
};

/// A box in the picture; its centre in pixels from the optical centre, right and down.
struct Box {
  double x_px = 0.0;
  double y_px = 0.0;
  double width_px = 0.0;
  double height_px = 0.0;
};

/// An object as it appears in a picture.
struct View {
  std::size_t object = 0;  ///< index into `BuildingMap::objects`
  Box box;
  double depth_m = 0.0;  ///< along the optical axis
  double range_m = 0.0;  ///< |p - x|
};

/// Takes pictures from one pose.
class Photographer {
 public:
  Photographer(const Camera& camera, const CameraPose& pose);

  /// The box around an object, a rectangle as wide as the camera looks and as high as it stands, for an image distance;
  /// none where it lies less than `nearest_m` before the camera, is too far, too small or not wholly in the picture.
  /// Without pitch and roll the height of the box is h v / u on the sensor, u the depth, so that
  /// r^2 = alpha (v^2 + l^2) holds exactly.
  std::optional<View> view(const MapObject& object, std::size_t number, double image_distance_mm) const;

  static constexpr double nearest_m = 0.5;

 private:
  std::array<double, 3> to_camera(const std::array<double, 3>& place) const;

  Camera camera_;
  std::array<double, 3> position_;
  std::array<double, 3> right_;
  std::array<double, 3> down_;
  std::array<double, 3> forward_;
  std::array<double, 3> level_right_;  ///< to the right, level
};

/// What a camera sees of a map, in the order of its objects: nothing behind walls. The lens is focused on what lies
/// nearest to the optical axis, on the focal length where nothing is seen. Writes the image distance (mm) too.
/// Allocates only where `views` grows.
void take_photo(const BuildingMap& map, const Camera& camera, const CameraPose& pose, std::vector<View>& views,
                double& image_distance_mm);

}  // namespace ridgeloc::sim
