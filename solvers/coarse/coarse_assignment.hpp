#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace ridgeloc::solvers {

/// Most nodes of an image and of a map graph.
inline constexpr std::size_t max_image_nodes = 16;
inline constexpr std::size_t max_graph_nodes = 255;

/// By image node: the node of the graph that it is matched with, or `unmatched_node`.
using NodeMatches = std::array<std::uint8_t, max_image_nodes>;
inline constexpr std::uint8_t unmatched_node = 255;

/// A photo, ready to be matched with the graphs of a database. Logarithms are integers, in units of 2^-32, so that sums
/// of them are exact and ties do not depend on the order of addition.
struct PreparedImage {
  std::size_t nodes = 0;
  std::array<std::size_t, max_image_nodes> classes;  ///< by node: number of its class in the database
  std::array<std::int64_t, max_image_nodes> log_heights;
  std::array<std::array<std::uint8_t, max_image_nodes>, max_image_nodes> relations;
};

/// A graph of a database: its nodes class after class, within a class by number.
struct PreparedGraph {
  std::size_t nodes;
  const std::uint8_t* class_begin;  ///< by class: its first node; at the end the number of nodes
  const std::uint8_t* numbers;      ///< by node: its number in the graph as it was given
  const std::uint8_t* relations;    ///< nodes x nodes, with `same_node` on the diagonal
  const std::int64_t* log_heights;  ///< by node
};
inline constexpr std::uint8_t same_node = 16;

/// A class-consistent injective assignment of image nodes to graph nodes, and what it is worth.
struct Assignment {
  int agreement = 0;  ///< summed over pairs of matches, 1 for equal LR and 1 for equal UD; at most N (N - 1)
  std::int64_t size_difference = std::numeric_limits<std::int64_t>::max();  ///< sum of |log height - log height|
  NodeMatches matches = {};
};

/// Room for searches. Grows only. Not synchronized: one per thread.
struct AssignmentScratch {
  std::vector<std::int16_t> gains;             ///< matches made x cells; a cell is a possible match
  std::vector<std::int16_t> prospects;         ///< depth x cells
  std::vector<int> largest_reaches;            ///< matches made x image nodes
  std::vector<std::int64_t> size_differences;  ///< by cell
};

/// The agreement of n matches whose relations are all equal: 2 for each pair.
constexpr int full_agreement(std::size_t n) {
  return n == 0 ? 0 : static_cast<int>(n * (n - 1));
}

/// Replaces `best` by the best assignment of maximal size, min(image nodes, graph nodes) matches in every class, if
/// that is better: more agreement, or as much and a smaller size difference (`sizes`; otherwise all of them are 0).
/// Returns whether it did. Of equal assignments the first counts, image nodes being in the order of the search (by
/// number of graph nodes of their class, then class, then number) and trying graph nodes by number, then none.
///
/// Branch and bound. Image nodes are matched one after the other, those whose class is rarest in the graph first. For a
/// possible later match,
///   gain      is its agreement with the matches made,
///   prospect  the most that it may agree with the matches, yet to be made, of nodes before its own, each pair for
///             itself (as in the bound of Gilmore and Lawler for quadratic assignments): the same in all branches,
///   reach     the sum of both.
/// No completion of a branch agrees more than the branch does, plus the largest reach of every later image node.
/// At worst the time grows exponentially with the image nodes of one class.
bool improve_assignment(const PreparedImage& image, const PreparedGraph& graph, bool sizes, AssignmentScratch& scratch,
                        Assignment& best);

}  // namespace ridgeloc::solvers
