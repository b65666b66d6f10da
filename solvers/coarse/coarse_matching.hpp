#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "solvers/coarse/coarse_assignment.hpp"
#include "solvers/coarse/coarse_graph.hpp"

/// Coarse positioning: which poses of a grid on the map see what a photo shows? The rules of the RRR paper are
/// unpublished; these are our reconstruction.
///
/// | symbol | |
/// |---|---|
/// | I | nodes of the image |
/// | G | nodes of the graph of a pose |
/// | N | image nodes matched, each with a node of its class, no two with the same |
/// | a | mean agreement over pairs of matches: ([LR equal] + [UD equal]) / 2, see `relation`; 0 where N < 2 |
///
///     score = (N + lambda a) / (I + mu (G - N))
///
/// The score of a graph is that of its best assignment. With 0 <= lambda <= 1, mu >= 0 one of maximal size is best,
/// N = sum over classes of min(nodes in the image, nodes in the graph): where N is smaller, some class has an unmatched
/// node on either side. Matching these two makes the denominator no larger, and the numerator at least
/// N + 1 >= N + lambda >= N + lambda a, whatever a becomes.
namespace ridgeloc::solvers {

/// What decides between graphs of equal score, and between assignments to a graph that agree equally.
enum class CoarseTies {
  Size,   ///< the smallest mean |log(box height in the image / in the graph)| over matches, then the order
  Order,  ///< the number of the graph
};
inline constexpr std::array<std::string_view, 2> coarse_ties_names = {"size", "order"};

struct CoarseOptions {
  double agreement_weight = 1.0;    ///< lambda, 0 to 1
  double unmatched_penalty = 0.25;  ///< mu, at least 0
  std::size_t top = 4;              ///< poses wanted
  std::size_t min_matched = 3;      ///< graphs with a smaller N are no candidates; at least 1
  CoarseTies ties = CoarseTies::Size;
};

/// The score from whole numbers; `agreement` is N (N - 1) a. Rounds once if lambda, mu are multiples of 2^-20 or so:
/// equal scores are then equal numbers.
double coarse_score(std::size_t image_nodes, std::size_t graph_nodes, std::size_t matched, int agreement,
                    const CoarseOptions& options);

/// A pose that may have taken the photo.
struct CoarsePose {
  std::size_t graph;
  double score;
  double size_difference;  ///< mean |log(height in the image / in the graph)| over matches; 0 with CoarseTies::Order
  std::size_t matched;     ///< N
  NodeMatches matches;     ///< by image node
};

/// Room for a match. Grows only. Not synchronized: one per thread.
struct CoarseScratch {
  /// The graphs of one size with one N, which are next of all graphs of that size.
  struct Cursor {
    std::size_t group;
    std::size_t matched;
    double bound;  ///< their score with full agreement
  };
  std::vector<std::uint8_t> matched;  ///< N by graph
  std::vector<Cursor> cursors;
  AssignmentScratch assignment;
};

/// Map graphs, in an order in which few of them need to be looked at. Immutable: any number of threads may share one.
class MapGraphDatabase {
 public:
  /// Throws std::invalid_argument where a graph has more than `max_graph_nodes` nodes, a number of objects that is not
  /// that of its nodes, or boxes without a positive size.
  explicit MapGraphDatabase(std::vector<MapGraph> graphs);

  const std::vector<MapGraph>& graphs() const { return graphs_; }

  /// The `options.top` best poses, best first: by score, then as `options.ties` says, then by number of graph. Fewer
  /// where there are fewer candidates. The result depends on the arguments alone. Allocates only to grow `scratch` and
  /// `out`. Throws std::invalid_argument where the image has more than `max_image_nodes` nodes or boxes without a
  /// positive size, or an option is outside its bounds.
  ///
  /// N is computed for all graphs, 16 or more at a time. Graphs are then visited in the order of the score that they
  /// would have with full agreement, until it is below that of the worst pose kept.
  void match(std::span<const GraphNode> image, const CoarseOptions& options, CoarseScratch& scratch,
             std::vector<CoarsePose>& out) const;

 private:
  /// The graphs with one number of nodes: places `begin` to `end` of the order.
  struct Group {
    std::size_t nodes;
    std::size_t begin;
    std::size_t end;
    std::size_t first_node;      // index into what is kept by node
    std::size_t first_relation;  // index into relations_
  };

  void add(std::size_t place);
  PreparedImage prepare(std::span<const GraphNode> image) const;
  PreparedGraph prepared(const Group& group, std::size_t place) const;
  void count_matches(const PreparedImage& image, std::vector<std::uint8_t>& matched) const;
  void visit(const CoarseScratch::Cursor& cursor, const PreparedImage& image, const CoarseOptions& options,
             CoarseScratch& scratch, std::vector<CoarsePose>& out) const;

  std::vector<MapGraph> graphs_;
  std::vector<std::uint32_t> classes_;  // ascending; the number of a class is its index, that of all others the size
  std::vector<std::size_t> order_;      // numbers of graphs by number of nodes, then number
  std::vector<Group> groups_;
  std::size_t stride_ = 0;            // of counts_
  std::vector<std::uint8_t> counts_;  // class x place: nodes of the class
  // As in PreparedGraph, one graph after the other.
  std::vector<std::uint8_t> class_begins_;
  std::vector<std::uint8_t> numbers_;
  std::vector<std::uint8_t> relations_;
  std::vector<std::int64_t> log_heights_;
};

}  // namespace ridgeloc::solvers
