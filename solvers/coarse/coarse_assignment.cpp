#include "solvers/coarse/coarse_assignment.hpp"

#include <algorithm>
#include <cstdlib>

namespace ridgeloc::solvers {

namespace {

/// What a match gains that would use a node of the graph again: no branch with it is worth anything.
constexpr int taken = -1024;
static_assert(-taken > static_cast<int>(max_image_nodes * (max_image_nodes - 1)));

/// Agreement of two relations by the bits in which they differ: LR is in bits 0 and 1, UD in bits 2 and 3.
constexpr auto agreement_by_difference = [] {
  std::array<std::int16_t, 2 * same_node> table{};
  for (unsigned bits = 0; bits < table.size(); ++bits) {
    const int agreement = ((bits & 3U) == 0U ? 1 : 0) + ((bits & 12U) == 0U ? 1 : 0);
    table[bits] = static_cast<std::int16_t>(bits < same_node ? agreement : taken);
  }
  return table;
}();

class Search {
 public:
  Search(const PreparedImage& image, const PreparedGraph& graph, bool sizes, AssignmentScratch& scratch,
         Assignment& best)
      : image_(image), graph_(graph), scratch_(scratch), best_(best) {
    matches_.fill(unmatched_node);
    order_variables();
    compare_sizes(sizes);
  }

  bool run() {
    if (!worth(full_agreement(size_), least_difference(0))) return false;
    grow(scratch_.gains, (size_ + 1) * cells_);
    grow(scratch_.prospects, (count_ + 1) * cells_);
    grow(scratch_.largest_reaches, (size_ + 1) * count_);
    std::fill_n(scratch_.gains.begin(), cells_, std::int16_t{0});
    const int reach = find_prospects();
    descend(0, {.matches = 0, .spare = 0, .agreement = 0, .reach = reach, .size_difference = 0});
    return found_;
  }

 private:
  /// An image node whose class the graph has. Its candidates, the graph nodes of that class, each have a cell.
  struct Variable {
    std::size_t node;
    std::size_t begin;
    std::size_t end;
    std::size_t cell;
    std::size_t spare;              // how many image nodes of its class find no match
    std::int64_t least_difference;  // of the sizes of all matches from this one on
  };

  struct Branch {
    std::size_t matches;
    std::size_t spare;  // image nodes of the class at hand that may still go unmatched
    int agreement;
    int reach;  // how much more agreement later matches may add
    std::int64_t size_difference;
  };

  void order_variables() {
    for (std::size_t i = 0; i < image_.nodes; ++i) {
      const std::size_t begin = graph_.class_begin[image_.classes[i]];
      const std::size_t end = graph_.class_begin[image_.classes[i] + 1];
      if (begin == end) continue;
      const auto later = [&](const Variable& v) {
        return v.end - v.begin > end - begin || (v.end - v.begin == end - begin && v.begin > begin);
      };
      std::size_t at = count_++;
      for (; at > 0 && later(variables_[at - 1]); --at) variables_[at] = variables_[at - 1];
      variables_[at] = {.node = i, .begin = begin, .end = end, .cell = 0, .spare = 0, .least_difference = 0};
    }
    for (std::size_t first = 0, last = 0; first < count_; first = last) {
      while (last < count_ && variables_[last].begin == variables_[first].begin) ++last;
      const std::size_t candidates = variables_[first].end - variables_[first].begin;
      const std::size_t matches = std::min(last - first, candidates);
      for (std::size_t d = first; d < last; ++d, cells_ += candidates) {
        variables_[d].cell = cells_;
        variables_[d].spare = last - first - matches;
      }
      size_ += matches;
    }
  }

  void compare_sizes(bool sizes) {
    auto& differences = scratch_.size_differences;
    grow(differences, cells_);
    std::fill_n(differences.begin(), cells_, std::int64_t{0});
    if (!sizes) return;
    for (std::size_t d = count_; d-- > 0;) {
      Variable& v = variables_[d];
      std::int64_t least = std::numeric_limits<std::int64_t>::max();
      for (std::size_t h = v.begin; h < v.end; ++h) {
        const std::int64_t difference = std::abs(image_.log_heights[v.node] - graph_.log_heights[h]);
        differences[v.cell + h - v.begin] = difference;
        least = std::min(least, difference);
      }
      v.least_difference = least_difference(d + 1) + (v.spare == 0 ? least : 0);
    }
  }

  void descend(std::size_t depth, const Branch& branch) {
    if (depth == count_) {
      best_ = {branch.agreement, branch.size_difference, matches_};
      found_ = true;
      return;
    }
    const Variable& v = variables_[depth];
    const std::size_t level = branch.matches;
    const bool opens_class = depth == 0 || variables_[depth - 1].begin != v.begin;
    const std::size_t spare = opens_class ? v.spare : branch.spare;
    const int later_reach = branch.reach - scratch_.largest_reaches[level * count_ + depth];
    for (std::size_t h = v.begin; h < v.end; ++h) {
      const std::size_t cell = v.cell + h - v.begin;
      const int gain = scratch_.gains[level * cells_ + cell];
      Branch next{.matches = level + 1,
                  .spare = spare,
                  .agreement = branch.agreement + gain,
                  .reach = later_reach,
                  .size_difference = branch.size_difference + scratch_.size_differences[cell]};
      const std::int64_t least = next.size_difference + least_difference(depth + 1);
      // First with what was known before this match, which spares most branches the computation of the gains.
      if (!worth(next.agreement + next.reach, least)) continue;
      next.reach = add_gains(depth, h, level);
      if (!worth(next.agreement + next.reach, least)) continue;
      matches_[v.node] = graph_.numbers[h];
      descend(depth + 1, next);
    }
    matches_[v.node] = unmatched_node;
    if (spare > 0 && worth(branch.agreement + later_reach, branch.size_difference + least_difference(depth + 1))) {
      descend(depth + 1, {.matches = level,
                          .spare = spare - 1,
                          .agreement = branch.agreement,
                          .reach = later_reach,
                          .size_difference = branch.size_difference});
    }
  }

  /// For every depth, the prospects of all later variables; those of depth 0 are for the root, where nothing is matched
  /// and every variable is later. Returns the reach of the root.
  int find_prospects() {
    int reach = 0;
    for (std::size_t d = 0; d < count_; ++d) {
      const Variable& v = variables_[d];
      int largest = 0;
      for (std::size_t h = v.begin, cell = v.cell; h < v.end; ++h, ++cell) {
        int prospect = 0;
        for (std::size_t e = d; e-- > 0;) {
          scratch_.prospects[(e + 1) * cells_ + cell] = static_cast<std::int16_t>(prospect);
          prospect += most_agreement(v, h, variables_[e]);
        }
        scratch_.prospects[cell] = static_cast<std::int16_t>(prospect);
        largest = std::max(largest, prospect);
      }
      scratch_.largest_reaches[d] = largest;
      reach += largest;
    }
    return reach;
  }

  /// Of the match of v with graph node h and any match of u.
  int most_agreement(const Variable& v, std::size_t h, const Variable& u) const {
    const std::uint8_t in_image = image_.relations[v.node][u.node];
    const std::uint8_t* in_graph = graph_.relations + h * graph_.nodes;
    std::int16_t most = 0;
    for (std::size_t k = u.begin; k < u.end; ++k)
      most = std::max(most, agreement_by_difference[in_image ^ in_graph[k]]);
    return most;
  }

  /// Gains and largest reaches of the later variables at the next level. Returns the reach of the branch.
  int add_gains(std::size_t depth, std::size_t matched, std::size_t level) {
    const std::int16_t* now = scratch_.gains.data() + level * cells_;
    std::int16_t* next = scratch_.gains.data() + (level + 1) * cells_;
    const std::int16_t* prospects = scratch_.prospects.data() + (depth + 1) * cells_;
    int* largest_reaches = scratch_.largest_reaches.data() + (level + 1) * count_;
    const std::uint8_t* in_graph = graph_.relations + matched * graph_.nodes;
    const auto& in_image = image_.relations[variables_[depth].node];
    int sum = 0;
    for (std::size_t d = depth + 1; d < count_; ++d) {
      const Variable& v = variables_[d];
      int largest = 0;
      for (std::size_t h = v.begin, cell = v.cell; h < v.end; ++h, ++cell) {
        const int gain = now[cell] + agreement_by_difference[in_image[v.node] ^ in_graph[h]];
        next[cell] = static_cast<std::int16_t>(gain);
        largest = std::max(largest, gain + prospects[cell]);
      }
      largest_reaches[d] = largest;
      sum += largest;
    }
    return sum;
  }

  bool worth(int agreement, std::int64_t size_difference) const {
    return agreement > best_.agreement || (agreement == best_.agreement && size_difference < best_.size_difference);
  }

  std::int64_t least_difference(std::size_t depth) const {
    return depth < count_ ? variables_[depth].least_difference : 0;
  }

  template <class Value>
  static void grow(std::vector<Value>& room, std::size_t size) {
    if (room.size() < size) room.resize(size);
  }

  const PreparedImage& image_;
  const PreparedGraph& graph_;
  AssignmentScratch& scratch_;
  Assignment& best_;
  std::array<Variable, max_image_nodes> variables_;
  std::size_t count_ = 0;  // variables
  std::size_t cells_ = 0;
  std::size_t size_ = 0;  // matches of an assignment of maximal size
  NodeMatches matches_;
  bool found_ = false;
};

}  // namespace

bool improve_assignment(const PreparedImage& image, const PreparedGraph& graph, bool sizes, AssignmentScratch& scratch,
                        Assignment& best) {
  return Search(image, graph, sizes, scratch, best).run();
}

}  // namespace ridgeloc::solvers
