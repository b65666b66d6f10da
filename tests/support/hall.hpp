#pragma once

#include <cstddef>
#include <vector>

#include "sim/building_map.hpp"
#include "sim/camera.hpp"

namespace ridgeloc::tests {

/// An object of class `object_class` with its centre at (x, y, z).
inline sim::MapObject object_at(double x, double y, double z, double width_m = 0.5, double height_m = 0.5,
                                std::size_t object_class = 0) {
  return {"object", object_class, {x, y, z}, width_m, height_m};
}

/// One area of 40 x 40 m around the origin with these objects, of classes "a", "b" and "c".
inline sim::BuildingMap hall(std::vector<sim::MapObject> objects) {
  sim::BuildingMap map;
  map.name = "hall";
  map.areas = {{"hall", {-20.0, 20.0}, {-20.0, 20.0}}};
  map.classes = {{"a", 0.5, 0.5, {}}, {"b", 0.5, 0.5, {}}, {"c", 0.5, 0.5, {}}};
  map.objects = std::move(objects);
  return map;
}

/// A camera in the middle of the hall, 1.5 m above its floor.
inline sim::CameraPose pose(double heading_turns = 0.0, double pitch_turns = 0.0, double roll_turns = 0.0) {
  return {{0.0, 0.0, 1.5}, heading_turns, pitch_turns, roll_turns};
}

}  // namespace ridgeloc::tests
