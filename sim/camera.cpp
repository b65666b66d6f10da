#include "sim/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/elementary.hpp"

namespace ridgeloc::sim {

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// cos a u + sin a w
Vector turned(const core::SinCos<double>& angle, const Vector& u, const Vector& w) {
  Vector out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = angle.cos * u[i] + angle.sin * w[i];
  return out;
}

Vector negative(const Vector& v) {
  return {-v[0], -v[1], -v[2]};
}

}  // namespace

double Camera::image_distance_mm(double focus_m) const {
  const double focus = std::max(1000.0 * focus_m, 2.0 * focal_length_mm);
  return focal_length_mm * focus / (focus - focal_length_mm);
}

Photographer::Photographer(const Camera& camera, const CameraPose& pose) : camera_(camera), position_(pose.position_m) {
  const core::SinCos<double> heading = core::sin_cos_turns(pose.heading_turns);
  const core::SinCos<double> pitch = core::sin_cos_turns(pose.pitch_turns);
  const core::SinCos<double> roll = core::sin_cos_turns(pose.roll_turns);
  const Vector level_forward{heading.cos, heading.sin, 0.0};
  const Vector up{0.0, 0.0, 1.0};
  level_right_ = {heading.sin, -heading.cos, 0.0};
  forward_ = turned(pitch, level_forward, up);
  const Vector level_down = negative(turned(pitch, up, negative(level_forward)));
  right_ = turned(roll, level_right_, level_down);
  down_ = turned(roll, level_down, negative(level_right_));
}

Vector Photographer::to_camera(const Vector& place) const {
  const Vector d{place[0] - position_[0], place[1] - position_[1], place[2] - position_[2]};
  return {dot(right_, d), dot(down_, d), dot(forward_, d)};
}

std::optional<View> Photographer::view(const MapObject& object, std::size_t number, double image_distance_mm) const {
  const Vector centre = to_camera(object.centre_m);
  const double squared_range = dot(centre, centre);
  if (squared_range > camera_.farthest_m * camera_.farthest_m || centre[2] < nearest_m) return std::nullopt;
  const double scale = image_distance_mm * camera_.pixels_per_mm();
  double left = std::numeric_limits<double>::infinity();
  double right = -left;
  double top = left;
  double bottom = -left;
  for (const double side : {-0.5, 0.5}) {
    for (const double rise : {-0.5, 0.5}) {
      Vector corner = object.centre_m;
      for (std::size_t i = 0; i < 3; ++i) corner[i] += side * object.width_m * level_right_[i];
      corner[2] += rise * object.height_m;
      const Vector at = to_camera(corner);
      if (at[2] < nearest_m) return std::nullopt;
      left = std::min(left, scale * at[0] / at[2]);
      right = std::max(right, scale * at[0] / at[2]);
      top = std::min(top, scale * at[1] / at[2]);
      bottom = std::max(bottom, scale * at[1] / at[2]);
    }
  }
  const double half_width = 0.5 * camera_.width_px;
  const double half_height = 0.5 * camera_.height_px;
  if (left < -half_width || right > half_width || top < -half_height || bottom > half_height) return std::nullopt;
  if (bottom - top < camera_.smallest_box_px) return std::nullopt;
  View view;
  view.object = number;
  view.box = {0.5 * (left + right), 0.5 * (top + bottom), right - left, bottom - top};
  view.depth_m = centre[2];
  view.range_m = std::sqrt(squared_range);
  return view;
}

void take_photo(const BuildingMap& map, const Camera& camera, const CameraPose& pose, std::vector<View>& views,
                double& image_distance_mm) {
  const Photographer photographer(camera, pose);
  const PlanPoint eye{pose.position_m[0], pose.position_m[1]};
  views.clear();
  image_distance_mm = camera.focal_length_mm;
  for (std::size_t i = 0; i < map.objects.size(); ++i) {
    const MapObject& object = map.objects[i];
    // Most objects of a large map are dismissed here.
    const double dx = object.centre_m[0] - eye[0];
    const double dy = object.centre_m[1] - eye[1];
    if (dx * dx + dy * dy > camera.farthest_m * camera.farthest_m) continue;
    const auto view = photographer.view(object, i, image_distance_mm);
    if (!view) continue;
    if (map.sees(eye, {object.centre_m[0], object.centre_m[1]})) views.push_back(*view);
  }
  if (views.empty()) return;
  const auto from_axis = [](const View& view) { return view.box.x_px * view.box.x_px + view.box.y_px * view.box.y_px; };
  image_distance_mm = camera.image_distance_mm(std::ranges::min_element(views, {}, from_axis)->depth_m);
  // Focusing only enlarges the picture: what stands at its edge may leave, and what was too small stays out.
  std::erase_if(views, [&](View& seen) {
    const auto view = photographer.view(map.objects[seen.object], seen.object, image_distance_mm);
    if (view) seen = *view;
    return !view;
  });
}

}  // namespace ridgeloc::sim
