#pragma once

#include <cstddef>
#include <vector>

#include "solvers/coarse/coarse_graph.hpp"

namespace ridgeloc::bench {

/// Map graphs of corridors, and photos to be matched with them.
struct CorridorViews {
  std::vector<solvers::MapGraph> graphs;
  std::vector<std::vector<solvers::GraphNode>> images;
};

/// As many graphs as wanted, of corridors of 2.4 x 52 m with lamps on the ceiling and objects of eight more classes
/// along the walls: the views of an iPhone 6 (61 x 48 deg) every 2 m and 45 deg that show something, up to 12 m away
/// and at most the 15 nearest objects. Each photo shows 3 to 7 nodes of one of the graphs, centres and sizes off by 10
/// and 5 % of the box (one standard deviation), one in five with one class wrong. The same numbers at every call.
CorridorViews corridor_views(std::size_t graphs, std::size_t images);

}  // namespace ridgeloc::bench
