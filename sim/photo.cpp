#include "sim/photo.hpp"

#include <algorithm>

#include "core/random.hpp"
#include "core/units.hpp"

namespace ridgeloc::sim {

namespace {

enum PoseDraw : std::uint64_t { Place, Heading, Tilt, pose_draws };

/// Half a side less the distance from walls, but never less than nothing: a narrow area has its middle line.
double half_room(const std::array<double, 2>& side, double wall_distance_m) {
  return std::max(0.5 * (side[1] - side[0]) - wall_distance_m, 0.0);
}

double along(const std::array<double, 2>& side, double wall_distance_m, double u) {
  return 0.5 * (side[0] + side[1]) + (2.0 * u - 1.0) * half_room(side, wall_distance_m);
}

}  // namespace

PhotoTaker::PhotoTaker(const BuildingMap& map, const PhotoOptions& options, const DetectorModel& detector,
                       std::uint64_t seed)
    : map_(map), options_(options), detector_(detector), poses_(seed, "photo"), errors_(detector_stream(seed)) {
  double sum = 0.0;
  for (const Rectangle& area : map.areas) areas_m2_.push_back(sum += area.area_m2());
}

CameraPose PhotoTaker::draw_pose(std::uint64_t trial, std::uint64_t attempt) const {
  const auto block = [&](PoseDraw draw) { return poses_.block(trial, attempt * pose_draws + draw); };
  const auto place = core::uniform_triple(block(Place));
  const auto heading = core::uniform_pair(block(Heading));
  const auto tilt = core::normal_pair(core::uniform_pair(block(Tilt)));
  const double at = place[0] * areas_m2_.back();
  const auto found = std::ranges::find_if(areas_m2_, [at](double sum) { return at <= sum; });
  const Rectangle& area = map_.areas[static_cast<std::size_t>(found - areas_m2_.begin())];
  CameraPose pose;
  pose.position_m = {along(area.x_m, options_.wall_distance_m, place[1]),
                     along(area.y_m, options_.wall_distance_m, place[2]), options_.height_m};
  pose.heading_turns = heading[0];
  pose.pitch_turns = options_.pitch_sigma_deg * core::turns_per_degree * tilt[0];
  pose.roll_turns = options_.roll_sigma_deg * core::turns_per_degree * tilt[1];
  return pose;
}

bool PhotoTaker::is_narrow(const Photo& photo) const {
  if (options_.widest_spread_deg >= 180.0 || photo.detections.empty()) return true;
  const auto [left, right] = std::ranges::minmax(photo.detections, {}, [](const Detection& d) { return d.box.x_px; });
  // d <= w for angles of 0 to 180 degrees is sin d cos w <= cos d sin w; the tangents of the two directions give a
  // multiple of sin d and cos d.
  const double focal_px = photo.image_distance_mm * options_.camera.pixels_per_mm();
  const core::SinCos<double> widest = core::sin_cos_turns(options_.widest_spread_deg * core::turns_per_degree);
  const double a = left.box.x_px / focal_px;
  const double b = right.box.x_px / focal_px;
  return (b - a) * widest.cos <= (1.0 + a * b) * widest.sin;
}

bool PhotoTaker::take_one(std::uint64_t trial, std::uint64_t attempt, Photo& photo) const {
  photo.pose = draw_pose(trial, attempt);
  photo.attempts = attempt + 1;
  take_photo(map_, options_.camera, photo.pose, photo.views, photo.image_distance_mm);
  if (photo.views.size() < options_.least_visible) return false;
  photo.detections.clear();
  for (const View& view : photo.views) {
    if (const auto found = detect(detector_, map_, view, errors_, trial, attempt)) photo.detections.push_back(*found);
  }
  return true;
}

bool PhotoTaker::take(std::uint64_t trial, std::size_t detections, Photo& photo) const {
  for (std::uint64_t attempt = 0; attempt < most_attempts; ++attempt) {
    if (!take_one(trial, attempt, photo)) continue;
    if (detections != 0 && photo.detections.size() != detections) continue;
    if (is_narrow(photo)) return true;
  }
  return false;
}

std::size_t table1_detections(double u) {
  constexpr std::size_t fewest = 3;
  constexpr std::array<double, 5> photos = {47, 22, 7, 3, 1};
  constexpr double all = 80;
  double below = 0.0;
  for (std::size_t i = 0; i < photos.size(); ++i) {
    below += photos[i];
    if (u * all < below) return fewest + i;
  }
  return fewest + photos.size() - 1;
}

}  // namespace ridgeloc::sim
