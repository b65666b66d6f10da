#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/coarse/coarse_matching.hpp"

namespace ridgeloc::bench {

/// Coarse positioning as one would write it at first: every graph is matched by backtracking, which gives a branch up
/// that cannot reach the best agreement even if all later pairs agreed, and all graphs are sorted.
/// Relations are computed beforehand. Sizes do not break ties.
class GraphScan {
 public:
  explicit GraphScan(std::span<const solvers::MapGraph> graphs);

  /// As `MapGraphDatabase::match` with CoarseTies::Order, but for the choice between assignments to a graph that are
  /// equally good.
  void match(std::span<const solvers::GraphNode> image, const solvers::CoarseOptions& options,
             std::vector<solvers::CoarsePose>& out);

 private:
  struct Graph {
    std::vector<std::uint32_t> classes;
    std::vector<std::uint8_t> relations;
  };
  static Graph prepare(std::span<const solvers::GraphNode> nodes);
  void descend(const Graph& image, const Graph& graph, std::size_t node, std::size_t matched, int agreement);

  std::vector<Graph> graphs_;
  solvers::CoarsePose best_;
  int best_agreement_;
  std::size_t size_;
  solvers::NodeMatches matches_;
};

}  // namespace ridgeloc::bench
