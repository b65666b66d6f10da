#include "studies/ranging/given_objects.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "core/error.hpp"
#include "studies/solving/extent.hpp"

namespace ridgeloc::studies {

namespace {

std::vector<Place> places_of(const sim::PositionColumns& columns, std::size_t count) {
  std::vector<Place> places;
  for (std::size_t i = 0; i < count; ++i) places.push_back({columns[0][i], columns[1][i], columns[2][i]});
  return places;
}

std::string text_of(const Place& place) {
  return fmt::format("[{}, {}, {}]", place[0], place[1], place[2]);
}

std::size_t unknowns_of(const RangingCell& cell) {
  return core::position_parameters - (cell.knows_height ? 1 : 0);
}

void refuse_duplicates(const std::vector<Place>& objects) {
  std::vector<std::size_t> order(objects.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return objects[i]; });
  const auto same = [&](std::size_t a, std::size_t b) { return objects[a] == objects[b]; };
  const auto twice = std::ranges::adjacent_find(order, same);
  if (twice == order.end()) return;
  throw core::InputError(fmt::format("scene.objects_m: objects {} and {} are both at {}; leave one out", *twice + 1,
                                     *std::next(twice) + 1, text_of(objects[*twice])));
}

/// Where the camera may be if that is a few places; nothing for a box.
std::vector<Place> camera_places(const sim::GivenScene& scene) {
  if (!scene.cameras[0].empty()) return places_of(scene.cameras, scene.cameras[0].size());
  const auto& box = scene.box_m;
  if (std::ranges::any_of(box, [](const Interval& side) { return side[0] < side[1]; })) return {};
  return {{box[0][0], box[1][0], box[2][0]}};
}

}  // namespace

void check_given_objects(const RangingCell& cell) {
  constexpr std::size_t most_objects = 1000;
  const sim::GivenScene& scene = *cell.given;
  const std::size_t count = scene.objects[0].size();
  if (cell.has_images) {
    throw core::InputError(
        "scene.objects = \"given\" goes with scene.model = \"range\": a photo would need a direction of view");
  }
  if (count == 0) {
    throw core::InputError(
        "scene.objects = \"given\" needs scene.objects_m: a list of positions, [[0, 0, 2], [8, 0, 2], ...], or "
        "{ file = \"NAME.csv\" }");
  }
  if (cell.points > count) {
    throw core::InputError(
        fmt::format("scene.objects_used = {}, but scene.objects_m has {} objects; 0 uses all", cell.points, count));
  }
  const std::size_t needed = unknowns_of(cell);
  if (cell.points < needed || cell.points > most_objects) {
    throw core::InputError(fmt::format("scene.objects_m: {} objects are measured; {} to {} are allowed{}", cell.points,
                                       needed, most_objects,
                                       cell.knows_height ? "" : " (2 with a known height, scene.z_mode = \"fixed\")"));
  }
  const std::vector<Place> objects = places_of(scene.objects, cell.points);
  refuse_duplicates(objects);

  const auto is_nowhere = [](const Interval& side) { return side == Interval{0.0, 0.0}; };
  if (!scene.cameras[0].empty() && !std::ranges::all_of(scene.box_m, is_nowhere)) {
    throw core::InputError(
        "scene.camera_m gives the positions of the camera, so that scene.camera_x_m, camera_y_m and camera_z_m change "
        "nothing; leave one or the other out");
  }
  for (const Place& camera : camera_places(scene)) {
    const auto at = std::ranges::find(objects, camera);
    if (at == objects.end()) continue;
    throw core::InputError(fmt::format(
        "scene: the camera at {} stands on object {}, from where a range has no direction; move one of them",
        text_of(camera), at - objects.begin() + 1));
  }
}

bool has_few_camera_places(const RangingCell& cell) {
  return !camera_places(*cell.given).empty();
}

std::optional<std::string> ambiguity_of_given_objects(const RangingCell& cell) {
  const std::size_t dimensions = extent_of(places_of(cell.given->objects, cell.points), cell.knows_height).dimensions;
  if (dimensions >= unknowns_of(cell)) return std::nullopt;
  if (cell.knows_height) {
    return "all objects lie on one line, seen from above: every position has a mirror image behind it with the same "
           "ranges, and the start decides between them";
  }
  if (dimensions == 2) {
    return "all objects lie in one plane: every position has a mirror image behind it with the same ranges, and the "
           "start decides between them; a known height (scene.z_mode = \"fixed\") may tell them apart";
  }
  return "all objects lie on one line: ranges do not tell where around it the camera is";
}

}  // namespace ridgeloc::studies
