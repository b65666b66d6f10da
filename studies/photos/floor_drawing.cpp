#include "studies/photos/floor_drawing.hpp"

#include <algorithm>

namespace ridgeloc::studies {

using results::DrawnPoint;

DrawnPoint drawn(const sim::PlanPoint& place) {
  return {place[0], place[1]};
}

DrawnPoint drawn(const sim::MapObject& object) {
  return {object.centre_m[0], object.centre_m[1]};
}

std::vector<DrawnPoint> corners(const sim::Rectangle& r) {
  return {{r.x_m[0], r.y_m[0]}, {r.x_m[1], r.y_m[0]}, {r.x_m[1], r.y_m[1]}, {r.x_m[0], r.y_m[1]}};
}

std::vector<std::vector<DrawnPoint>> outlines(const sim::BuildingMap& map) {
  std::vector<std::vector<DrawnPoint>> lines;
  for (const sim::Wall& wall : sim::all_walls(map)) lines.push_back({drawn(wall.from_m), drawn(wall.to_m)});
  return lines;
}

results::DrawingWindow window_around(const std::vector<DrawnPoint>& places) {
  constexpr double margin_m = 1.5;
  constexpr double smallest_m = 12.0;
  constexpr double lowest = 0.35;  // height over width
  constexpr double highest = 1.25;
  auto [left, right] = std::ranges::minmax(places, {}, &DrawnPoint::x);
  auto [bottom, top] = std::ranges::minmax(places, {}, &DrawnPoint::y);
  double width = std::max(right.x - left.x + 2.0 * margin_m, smallest_m);
  double height = std::max(top.y - bottom.y + 2.0 * margin_m, lowest * width);
  width = std::max(width, height / highest);
  const double x = 0.5 * (left.x + right.x);
  const double y = 0.5 * (bottom.y + top.y);
  return {{x - 0.5 * width, x + 0.5 * width}, {y - 0.5 * height, y + 0.5 * height}};
}

}  // namespace ridgeloc::studies
