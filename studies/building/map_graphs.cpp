#include "studies/building/map_graphs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <mutex>
#include <numbers>

#include "core/error.hpp"
#include "solvers/coarse/coarse_assignment.hpp"

namespace ridgeloc::studies {

namespace {

/// Number of the parts of a side that are as nearly `spacing` long as an equal division allows.
std::size_t parts_of(const std::array<double, 2>& side, double spacing_m) {
  return std::max<std::size_t>(static_cast<std::size_t>(std::lround((side[1] - side[0]) / spacing_m)), 1);
}

/// Middles of these parts.
std::vector<double> along(const std::array<double, 2>& side, double spacing_m) {
  const double length = side[1] - side[0];
  const std::size_t parts = parts_of(side, spacing_m);
  std::vector<double> places;
  for (std::size_t i = 0; i < parts; ++i) {
    places.push_back(side[0] + length * (static_cast<double>(i) + 0.5) / static_cast<double>(parts));
  }
  return places;
}

/// What of a map lies around a place. What a camera there sees no further than `reach_m` is the same.
struct Surroundings {
  Surroundings(const sim::BuildingMap& whole, const sim::PlanPoint& place, double reach_m) {
    const auto is_near = [&](const sim::Rectangle& r) {
      return r.x_m[0] <= place[0] + reach_m && r.x_m[1] >= place[0] - reach_m && r.y_m[0] <= place[1] + reach_m &&
             r.y_m[1] >= place[1] - reach_m;
    };
    std::ranges::copy_if(whole.areas, std::back_inserter(map.areas), is_near);
    std::ranges::copy_if(whole.openings, std::back_inserter(map.openings), is_near);
    map.walls = whole.walls;
    for (std::size_t i = 0; i < whole.objects.size(); ++i) {
      const sim::MapObject& object = whole.objects[i];
      const double dx = object.centre_m[0] - place[0];
      const double dy = object.centre_m[1] - place[1];
      if (dx * dx + dy * dy > reach_m * reach_m) continue;
      map.objects.push_back(object);
      numbers.push_back(i);
    }
  }

  sim::BuildingMap map;
  std::vector<std::size_t> numbers;  ///< of its objects in the whole map
};

}  // namespace

solvers::GraphNode node_of(std::size_t object_class, const sim::Box& box) {
  return {static_cast<std::uint32_t>(object_class), box.x_px, box.y_px, box.width_px, box.height_px};
}

std::vector<sim::PlanPoint> grid_places(const sim::BuildingMap& map, double spacing_m) {
  std::vector<sim::PlanPoint> places;
  for (const sim::Rectangle& area : map.areas) {
    const std::vector<double> ys = along(area.y_m, spacing_m);
    for (const double x : along(area.x_m, spacing_m)) {
      for (const double y : ys) places.push_back({x, y});
    }
  }
  return places;
}

std::size_t grid_size(const sim::BuildingMap& map, double spacing_m) {
  std::size_t size = 0;
  for (const sim::Rectangle& area : map.areas) size += parts_of(area.x_m, spacing_m) * parts_of(area.y_m, spacing_m);
  return size;
}

std::vector<solvers::MapGraph> map_graphs(const sim::BuildingMap& map, const sim::Camera& camera, double height_m,
                                          double spacing_m, std::size_t headings) {
  std::vector<solvers::MapGraph> graphs;
  std::vector<sim::View> views;
  double image_distance_mm = 0.0;
  for (const sim::PlanPoint& place : grid_places(map, spacing_m)) {
    const Surroundings around(map, place, camera.farthest_m);
    for (std::size_t h = 0; h < headings; ++h) {
      sim::CameraPose pose;
      pose.position_m = {place[0], place[1], height_m};
      pose.heading_turns = static_cast<double>(h) / static_cast<double>(headings);
      sim::take_photo(around.map, camera, pose, views, image_distance_mm);
      if (views.empty()) continue;
      if (views.size() > solvers::max_graph_nodes) {
        throw core::InputError(fmt::format(
            "from ({}, {}) {} objects of the map \"{}\" are seen, more than {}; make photo.farthest_m smaller",
            place[0], place[1], views.size(), map.name, solvers::max_graph_nodes));
      }
      solvers::MapGraph& graph = graphs.emplace_back();
      graph.x_m = place[0];
      graph.y_m = place[1];
      graph.heading_rad = 2.0 * std::numbers::pi * pose.heading_turns;
      for (const sim::View& view : views) {
        graph.nodes.push_back(node_of(around.map.objects[view.object].object_class, view.box));
        graph.objects.push_back(around.numbers[view.object]);
      }
    }
  }
  return graphs;
}

std::shared_ptr<const solvers::MapGraphDatabase> shared_map_graphs(const MapGraphKey& key) {
  struct Known {
    MapGraphKey key;
    std::weak_ptr<const solvers::MapGraphDatabase> graphs;
  };
  static std::mutex mutex;
  static std::vector<Known> all;
  const std::scoped_lock lock(mutex);
  std::erase_if(all, [](const Known& known) { return known.graphs.expired(); });
  for (const Known& known : all) {
    if (known.key != key) continue;
    if (auto graphs = known.graphs.lock()) return graphs;
  }
  auto made = std::make_shared<const solvers::MapGraphDatabase>(
      map_graphs(key.building.map(), key.camera, key.height_m, key.spacing_m, key.headings));
  all.push_back({key, made});
  return made;
}

}  // namespace ridgeloc::studies
