#include "bench/corridors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace ridgeloc::bench {

namespace {

using solvers::GraphNode;
using solvers::MapGraph;

constexpr double length_m = 52.0;
constexpr double half_width_m = 1.2;
constexpr double camera_height_m = 1.5;
constexpr double farthest_m = 12.0;
constexpr double nearest_m = 0.5;
constexpr double focal_px = 2767.0;
constexpr double half_image_px[] = {1632.0, 1224.0};
constexpr std::size_t most_nodes = 15;

/// The standard library's distributions differ between implementations.
double uniform(std::mt19937_64& engine, double low, double high) {
  return low + (high - low) * std::ldexp(static_cast<double>(engine() >> 11U), -53);
}

double normal(std::mt19937_64& engine) {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform(engine, 0.0, 1.0)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(engine, 0.0, 1.0));
}

struct Kind {
  double z_m;  ///< of the centre
  double width_m;
  double height_m;
};
constexpr std::uint32_t lamp = 0;
constexpr std::array<Kind, 9> kinds = {{
    {2.6, 0.6, 0.15},  // lamp
    {1.0, 0.9, 2.0},   // door
    {1.5, 1.2, 1.2},   // window
    {0.3, 0.35, 0.6},  // bin
    {0.4, 1.2, 0.8},   // table
    {0.9, 0.8, 1.8},   // cabinet
    {0.6, 0.3, 1.2},   // water dispenser
    {1.0, 0.2, 0.5},   // fire extinguisher
    {1.6, 0.9, 0.7},   // notice board
}};

struct Object {
  std::uint32_t object_class;
  double x_m;
  double y_m;
};

std::vector<Object> random_corridor(std::mt19937_64& engine) {
  std::vector<Object> objects;
  const double first_lamp_m = uniform(engine, 0.0, 3.0);
  for (double x = first_lamp_m; x < length_m; x += 3.0) objects.push_back({lamp, x, 0.0});
  for (const double y : {-half_width_m, half_width_m}) {
    for (double x = uniform(engine, 0.0, 3.0); x < length_m; x += uniform(engine, 1.0, 5.0))
      objects.push_back({static_cast<std::uint32_t>(1 + engine() % (kinds.size() - 1)), x, y});
  }
  return objects;
}

MapGraph view(const std::vector<Object>& corridor, double x_m, double heading_rad) {
  struct Seen {
    double depth_m;
    GraphNode node;
    std::size_t object;
  };
  std::vector<Seen> seen;
  for (std::size_t i = 0; i < corridor.size(); ++i) {
    const Kind& kind = kinds[corridor[i].object_class];
    const double dx = corridor[i].x_m - x_m;
    const double dy = corridor[i].y_m;
    const double depth_m = dx * std::cos(heading_rad) + dy * std::sin(heading_rad);
    if (depth_m < nearest_m || depth_m > farthest_m) continue;
    const double scale = focal_px / depth_m;
    const GraphNode node{.object_class = corridor[i].object_class,
                         .x_px = scale * (dx * std::sin(heading_rad) - dy * std::cos(heading_rad)),
                         .y_px = scale * (camera_height_m - kind.z_m),
                         .width_px = scale * kind.width_m,
                         .height_px = scale * kind.height_m};
    if (std::abs(node.x_px) < half_image_px[0] && std::abs(node.y_px) < half_image_px[1])
      seen.push_back({depth_m, node, i});
  }
  std::ranges::sort(seen, {}, &Seen::depth_m);
  seen.resize(std::min(seen.size(), most_nodes));
  MapGraph graph{.nodes = {}, .objects = {}, .x_m = x_m, .y_m = 0.0, .heading_rad = heading_rad};
  for (const Seen& one : seen) {
    graph.nodes.push_back(one.node);
    graph.objects.push_back(one.object);
  }
  return graph;
}

std::vector<GraphNode> photo(std::vector<GraphNode> nodes, std::mt19937_64& engine) {
  // The nodes that are seen, drawn without replacement.
  const std::size_t count = std::min<std::size_t>(nodes.size(), 3 + engine() % 5);
  for (std::size_t i = 0; i < count; ++i) std::swap(nodes[i], nodes[i + engine() % (nodes.size() - i)]);
  nodes.resize(count);
  for (GraphNode& node : nodes) {
    node.x_px += 0.1 * node.width_px * normal(engine);
    node.y_px += 0.1 * node.height_px * normal(engine);
    node.width_px *= std::exp(0.05 * normal(engine));
    node.height_px *= std::exp(0.05 * normal(engine));
  }
  if (engine() % 5 == 0) nodes[0].object_class = static_cast<std::uint32_t>(engine() % kinds.size());
  return nodes;
}

}  // namespace

CorridorViews corridor_views(std::size_t graphs, std::size_t images) {
  std::mt19937_64 engine(458);
  CorridorViews views;
  while (views.graphs.size() < graphs) {
    const std::vector<Object> corridor = random_corridor(engine);
    for (double x_m = 1.0; x_m < length_m; x_m += 2.0) {
      for (int eighth = 0; eighth < 8; ++eighth) {
        MapGraph graph = view(corridor, x_m, eighth * std::numbers::pi / 4.0);
        if (!graph.nodes.empty() && views.graphs.size() < graphs) views.graphs.push_back(std::move(graph));
      }
    }
  }
  while (views.images.size() < images) {
    const MapGraph& graph = views.graphs[engine() % views.graphs.size()];
    if (graph.nodes.size() >= 3) views.images.push_back(photo(graph.nodes, engine));
  }
  return views;
}

}  // namespace ridgeloc::bench
