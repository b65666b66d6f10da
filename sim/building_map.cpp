#include "sim/building_map.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace ridgeloc::sim {

namespace {

/// Part of a line from 0 to 1.
struct Span {
  double low;
  double high;
};

/// What of the line lies in a rectangle; low > high where nothing does.
Span clip(const Rectangle& r, const PlanPoint& from, const PlanPoint& to) {
  Span span{0.0, 1.0};
  const auto cut = [&span](double start, double end, const std::array<double, 2>& side) {
    const double along = end - start;
    if (along == 0.0) {
      if (start < side[0] || start > side[1]) span = {1.0, 0.0};
      return;
    }
    const double a = (side[0] - start) / along;
    const double b = (side[1] - start) / along;
    span = {std::max(span.low, std::min(a, b)), std::min(span.high, std::max(a, b))};
  };
  cut(from[0], to[0], r.x_m);
  cut(from[1], to[1], r.y_m);
  return span;
}

/// Twice the signed area of the triangle a, b, c.
double turn(const PlanPoint& a, const PlanPoint& b, const PlanPoint& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// A line over an end of the wall crosses it, so that nothing shows between walls that meet. One that ends on it does
/// not.
bool crosses(const Wall& wall, const PlanPoint& from, const PlanPoint& to) {
  return turn(wall.from_m, wall.to_m, from) * turn(wall.from_m, wall.to_m, to) < 0.0 &&
         turn(from, to, wall.from_m) * turn(from, to, wall.to_m) <= 0.0;
}

}  // namespace

bool BuildingMap::is_inside(const PlanPoint& p) const {
  return std::ranges::any_of(areas, [&p](const Rectangle& area) { return area.contains(p); });
}

bool BuildingMap::sees(const PlanPoint& from, const PlanPoint& to) const {
  // Most rectangles of a large map are dismissed here.
  const auto [left, right] = std::minmax(from[0], to[0]);
  const auto [bottom, top] = std::minmax(from[1], to[1]);
  const auto is_apart = [&](const Rectangle& r) {
    return r.x_m[1] < left || r.x_m[0] > right || r.y_m[1] < bottom || r.y_m[0] > top;
  };
  // Rounding must not open a gap between rectangles that touch.
  constexpr double tolerance = 1e-9;
  double reached = 0.0;
  for (bool grows = true; grows && reached < 1.0;) {
    grows = false;
    for (const auto* free : {&areas, &openings}) {
      for (const Rectangle& r : *free) {
        if (is_apart(r)) continue;
        const Span span = clip(r, from, to);
        if (span.low > reached + tolerance || span.high <= reached) continue;
        reached = span.high;
        grows = true;
      }
    }
  }
  if (reached < 1.0 - tolerance) return false;
  return std::ranges::none_of(walls, [&](const Wall& wall) { return crosses(wall, from, to); });
}

std::vector<Wall> all_walls(const BuildingMap& map) {
  std::vector<Rectangle> free = map.areas;
  free.insert(free.end(), map.openings.begin(), map.openings.end());
  std::vector<Wall> walls = map.walls;
  // The parts of a side, at `at` across it, that no other rectangle touches.
  const auto add_side = [&](const Rectangle& r, bool along_x, double at) {
    const auto side = [along_x](const Rectangle& q) { return along_x ? q.x_m : q.y_m; };
    const auto across = [along_x](const Rectangle& q) { return along_x ? q.y_m : q.x_m; };
    std::vector<std::array<double, 2>> open;
    for (const Rectangle& q : free) {
      if (q != r && across(q)[0] <= at && at <= across(q)[1]) open.push_back(side(q));
    }
    std::ranges::sort(open);
    open.push_back({side(r)[1], side(r)[1]});
    double from = side(r)[0];
    for (const auto& [low, high] : open) {
      const double to = std::min(low, side(r)[1]);
      if (to > from) {
        walls.push_back(along_x ? Wall{{from, at}, {to, at}} : Wall{{at, from}, {at, to}});
      }
      from = std::max(from, high);
    }
  };
  for (const Rectangle& r : free) {
    for (const double y : r.y_m) add_side(r, true, y);
    for (const double x : r.x_m) add_side(r, false, x);
  }
  return walls;
}

double distance_m(const PlanPoint& a, const PlanPoint& b) {
  const double dx = a[0] - b[0];
  const double dy = a[1] - b[1];
  return std::sqrt(dx * dx + dy * dy);
}

bool overlap(const Rectangle& a, const Rectangle& b) {
  const auto meet = [](const std::array<double, 2>& s, const std::array<double, 2>& t) {
    return s[0] < t[1] && t[0] < s[1];
  };
  return meet(a.x_m, b.x_m) && meet(a.y_m, b.y_m);
}

bool overlap(const MapObject& a, const MapObject& b) {
  // Squares: hypot is not the same to the last bit everywhere, and random maps depend on the answer.
  const double dx = a.centre_m[0] - b.centre_m[0];
  const double dy = a.centre_m[1] - b.centre_m[1];
  const double reach = 0.5 * (a.width_m + b.width_m);
  return dx * dx + dy * dy < reach * reach &&
         std::fabs(a.centre_m[2] - b.centre_m[2]) < 0.5 * (a.height_m + b.height_m);
}

std::optional<std::array<std::size_t, 2>> first_overlap(const std::vector<MapObject>& objects) {
  const auto length = [&](std::size_t axis) {
    const auto at = [axis](const MapObject& object) { return object.centre_m[axis]; };
    const auto [low, high] = std::ranges::minmax_element(objects, {}, at);
    return objects.empty() ? 0.0 : at(*high) - at(*low);
  };
  const std::array<double, 3> lengths = {length(0), length(1), length(2)};
  const auto axis = static_cast<std::size_t>(std::ranges::max_element(lengths) - lengths.begin());
  const auto half = [&](std::size_t i) { return 0.5 * (axis == 2 ? objects[i].height_m : objects[i].width_m); };
  const auto low = [&](std::size_t i) { return objects[i].centre_m[axis] - half(i); };
  const auto high = [&](std::size_t i) { return objects[i].centre_m[axis] + half(i); };
  std::vector<std::size_t> order(objects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, low);

  std::optional<std::array<std::size_t, 2>> first;
  std::vector<std::size_t> open;  // those that reach as far as the next one begins
  for (const std::size_t i : order) {
    constexpr double rounding_m = 1e-6;
    std::erase_if(open, [&](std::size_t j) { return high(j) < low(i) - rounding_m; });
    for (const std::size_t j : open) {
      if (!overlap(objects[i], objects[j])) continue;
      const std::array<std::size_t, 2> found = {std::max(i, j), std::min(i, j)};
      first = first ? std::min(*first, found) : found;
    }
    open.push_back(i);
  }
  return first;
}

}  // namespace ridgeloc::sim
