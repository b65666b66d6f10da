#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "sim/building_map.hpp"
#include "sim/camera.hpp"
#include "solvers/coarse/coarse_graph.hpp"
#include "solvers/coarse/coarse_matching.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::studies {

/// What map graphs are made from.
struct MapGraphKey {
  Building building;
  sim::Camera camera;
  double height_m;
  double spacing_m;
  std::size_t headings;

  friend bool operator==(const MapGraphKey&, const MapGraphKey&) = default;
};

/// The views of a grid of places in every area, `spacing` apart as nearly as the area's sides allow, and of `headings`
/// directions each; those that show nothing are left out. Throws core::InputError where a view shows more objects than
/// a map graph takes.
std::vector<solvers::MapGraph> map_graphs(const sim::BuildingMap& map, const sim::Camera& camera, double height_m,
                                          double spacing_m, std::size_t headings);

/// A database of them, made once: all who ask for the same one while somebody has it share it. Thread safe.
std::shared_ptr<const solvers::MapGraphDatabase> shared_map_graphs(const MapGraphKey& key);

/// Places of a grid over the areas of a map, likewise, and how many there are.
std::vector<sim::PlanPoint> grid_places(const sim::BuildingMap& map, double spacing_m);
std::size_t grid_size(const sim::BuildingMap& map, double spacing_m);

/// An object of a picture as a node of a graph.
solvers::GraphNode node_of(std::size_t object_class, const sim::Box& box);

}  // namespace ridgeloc::studies
