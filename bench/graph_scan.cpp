#include "bench/graph_scan.hpp"

#include <algorithm>
#include <tuple>

namespace ridgeloc::bench {

using solvers::CoarsePose;

GraphScan::GraphScan(std::span<const solvers::MapGraph> graphs) {
  for (const solvers::MapGraph& graph : graphs) graphs_.push_back(prepare(graph.nodes));
}

GraphScan::Graph GraphScan::prepare(std::span<const solvers::GraphNode> nodes) {
  Graph graph;
  for (const solvers::GraphNode& a : nodes) {
    graph.classes.push_back(a.object_class);
    for (const solvers::GraphNode& b : nodes) graph.relations.push_back(solvers::relation(a, b));
  }
  return graph;
}

void GraphScan::match(std::span<const solvers::GraphNode> image, const solvers::CoarseOptions& options,
                      std::vector<CoarsePose>& out) {
  const Graph prepared = prepare(image);
  out.clear();
  for (std::size_t g = 0; g < graphs_.size(); ++g) {
    const Graph& graph = graphs_[g];
    size_ = 0;
    for (auto c = prepared.classes.begin(); c != prepared.classes.end(); ++c) {
      const auto before = std::count(prepared.classes.begin(), c, *c);
      if (before < std::ranges::count(graph.classes, *c)) ++size_;
    }
    if (size_ < options.min_matched) continue;
    best_agreement_ = -1;
    matches_.fill(solvers::unmatched_node);
    descend(prepared, graph, 0, 0, 0);
    best_.graph = g;
    best_.score = coarse_score(image.size(), graph.classes.size(), size_, best_agreement_, options);
    best_.size_difference = 0.0;
    best_.matched = size_;
    out.push_back(best_);
  }
  std::ranges::sort(out, {}, [](const CoarsePose& pose) { return std::tuple(-pose.score, pose.graph); });
  out.resize(std::min(out.size(), options.top));
}

void GraphScan::descend(const Graph& image, const Graph& graph, std::size_t node, std::size_t matched, int agreement) {
  const std::size_t nodes = image.classes.size();
  if (matched + (nodes - node) < size_) return;
  const int most = agreement + static_cast<int>(size_ * (size_ - 1)) - static_cast<int>(matched * matched - matched);
  if (most <= best_agreement_) return;
  if (node == nodes) {
    best_agreement_ = agreement;
    best_.matches = matches_;
    return;
  }
  for (std::size_t k = 0; k < graph.classes.size(); ++k) {
    if (graph.classes[k] != image.classes[node]) continue;
    if (std::find(matches_.begin(), matches_.begin() + node, k) != matches_.begin() + node) continue;
    int gain = 0;
    for (std::size_t i = 0; i < node; ++i) {
      if (matches_[i] == solvers::unmatched_node) continue;
      const unsigned difference =
          image.relations[i * nodes + node] ^ graph.relations[matches_[i] * graph.classes.size() + k];
      gain += ((difference & 3U) == 0U ? 1 : 0) + ((difference & 12U) == 0U ? 1 : 0);
    }
    matches_[node] = static_cast<std::uint8_t>(k);
    descend(image, graph, node + 1, matched + 1, agreement + gain);
  }
  matches_[node] = solvers::unmatched_node;
  descend(image, graph, node + 1, matched, agreement);
}

}  // namespace ridgeloc::bench
