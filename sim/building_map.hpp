#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ridgeloc::sim {

/// A point of the floor plan: x, y in metres.
using PlanPoint = std::array<double, 2>;

/// A rectangle of the floor plan, its sides along the axes, borders included.
struct Rectangle {
  std::string name;
  std::array<double, 2> x_m;  ///< low, high
  std::array<double, 2> y_m;

  bool contains(const PlanPoint& p) const {
    return p[0] >= x_m[0] && p[0] <= x_m[1] && p[1] >= y_m[0] && p[1] <= y_m[1];
  }
  double area_m2() const { return (x_m[1] - x_m[0]) * (y_m[1] - y_m[0]); }

  friend bool operator==(const Rectangle&, const Rectangle&) = default;
};

/// A wall without thickness inside an area.
struct Wall {
  PlanPoint from_m;
  PlanPoint to_m;

  friend bool operator==(const Wall&, const Wall&) = default;
};

/// A kind of objects: what a detector tells apart.
struct ObjectClass {
  std::string name;
  double width_m = 0.0;  ///< of objects that do not say otherwise
  double height_m = 0.0;
  /// How often a detector finds an object of this class near and far, where the class differs from others.
  std::optional<std::array<double, 2>> recall = {};

  friend bool operator==(const ObjectClass&, const ObjectClass&) = default;
};

/// A thing of known place and size. It shows every camera a rectangle of its width and height.
struct MapObject {
  std::string name;
  std::size_t object_class = 0;      ///< index into `BuildingMap::classes`
  std::array<double, 3> centre_m{};  ///< x, y, z, z up from the floor
  double width_m = 0.0;
  double height_m = 0.0;

  friend bool operator==(const MapObject&, const MapObject&) = default;
};

/// A floor of a building. There are walls wherever there is neither an area nor an opening; where two of these touch
/// along their borders, one sees and walks from one into the other.
struct BuildingMap {
  std::string name;
  std::vector<Rectangle> areas;     ///< corridors and rooms: where a camera may be; they do not overlap
  std::vector<Rectangle> openings;  ///< doorways, which one looks through
  std::vector<Wall> walls;
  std::vector<ObjectClass> classes;
  std::vector<MapObject> objects;

  /// Whether a place lies in an area.
  bool is_inside(const PlanPoint& p) const;

  /// Whether nothing stands between two places: the line between them stays within areas and openings, and crosses no
  /// wall. What hangs on a wall is seen from both sides. Objects do not hide each other.
  bool sees(const PlanPoint& from, const PlanPoint& to) const;

  friend bool operator==(const BuildingMap&, const BuildingMap&) = default;
};

/// Every wall of a map: its own, and the borders of areas and openings where these do not touch another one.
std::vector<Wall> all_walls(const BuildingMap& map);

/// Distance on the floor plan (m).
double distance_m(const PlanPoint& a, const PlanPoint& b);

/// Whether the insides of two rectangles meet.
bool overlap(const Rectangle& a, const Rectangle& b);

/// Whether two objects stand in one another: their widths meet on the floor plan, taken around their centres, and their
/// heights do.
bool overlap(const MapObject& a, const MapObject& b);

/// The first object that overlaps one before it, and the first such one: {number, smaller number}. The time grows with
/// n log n, unless objects lie over each other along the longest side of their map.
std::optional<std::array<std::size_t, 2>> first_overlap(const std::vector<MapObject>& objects);

}  // namespace ridgeloc::sim
