#include "solvers/coarse/coarse_matching.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <ranges>
#include <stdexcept>
#include <string>
#include <tuple>

#include "core/elementary.hpp"

namespace ridgeloc::solvers {

namespace {

constexpr int log_fraction_bits = 32;

std::int64_t log_height(const GraphNode& node) {
  return std::llround(std::ldexp(core::log(node.height_px), log_fraction_bits));
}

void check_boxes(std::span<const GraphNode> nodes, const std::string& of) {
  for (const GraphNode& node : nodes) {
    const bool finite = std::isfinite(node.x_px) && std::isfinite(node.y_px) && std::isfinite(node.width_px) &&
                        std::isnormal(node.height_px);
    if (!finite || node.width_px <= 0.0 || node.height_px <= 0.0)
      throw std::invalid_argument(of + ": a box must be finite and of positive size");
  }
}

void check_options(const CoarseOptions& options) {
  if (!(options.agreement_weight >= 0.0 && options.agreement_weight <= 1.0))
    throw std::invalid_argument("coarse matching: agreement_weight must be from 0 to 1");
  if (!(options.unmatched_penalty >= 0.0 && std::isfinite(options.unmatched_penalty)))
    throw std::invalid_argument("coarse matching: unmatched_penalty must be finite and not negative");
  if (options.min_matched == 0) throw std::invalid_argument("coarse matching: min_matched must be at least 1");
}

/// sum[i] += min(counts[i], limit). A function of values, not of members: a byte that is stored may change any member,
/// and compilers would not take several places at once.
void add_smaller(const std::uint8_t* counts, std::uint8_t limit, std::size_t size, std::uint8_t* sum) {
  for (std::size_t i = 0; i < size; ++i)
    sum[i] = static_cast<std::uint8_t>(sum[i] + (counts[i] < limit ? counts[i] : limit));
}

const std::uint8_t* find_byte(const std::uint8_t* begin, const std::uint8_t* end, std::size_t value) {
  const void* found = std::memchr(begin, static_cast<int>(value), static_cast<std::size_t>(end - begin));
  return found == nullptr ? end : static_cast<const std::uint8_t*>(found);
}

bool better(const CoarsePose& a, const CoarsePose& b) {
  return std::tuple(-a.score, a.size_difference, a.graph) < std::tuple(-b.score, b.size_difference, b.graph);
}

}  // namespace

double coarse_score(std::size_t image_nodes, std::size_t graph_nodes, std::size_t matched, int agreement,
                    const CoarseOptions& options) {
  const auto n = static_cast<double>(matched);
  const double pairs = matched < 2 ? 1.0 : n * (n - 1.0);
  const double unmatched = static_cast<double>(graph_nodes - matched);
  return (n * pairs + options.agreement_weight * agreement) /
         (pairs * (static_cast<double>(image_nodes) + options.unmatched_penalty * unmatched));
}

MapGraphDatabase::MapGraphDatabase(std::vector<MapGraph> graphs) : graphs_(std::move(graphs)) {
  for (std::size_t g = 0; g < graphs_.size(); ++g) {
    const std::string name = "map graph " + std::to_string(g);
    const std::vector<GraphNode>& nodes = graphs_[g].nodes;
    if (nodes.size() > max_graph_nodes) {
      throw std::invalid_argument(name + ": " + std::to_string(nodes.size()) + " nodes, at most " +
                                  std::to_string(max_graph_nodes) + " are possible");
    }
    if (graphs_[g].objects.size() != nodes.size())
      throw std::invalid_argument(name + ": as many objects as nodes are needed");
    check_boxes(nodes, name);
    for (const GraphNode& node : nodes) classes_.push_back(node.object_class);
  }
  std::ranges::sort(classes_);
  classes_.erase(std::ranges::unique(classes_).begin(), classes_.end());

  order_.resize(graphs_.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::ranges::stable_sort(order_, {}, [this](std::size_t g) { return graphs_[g].nodes.size(); });

  // Whole vectors of any instruction set, so that the loop over the counts needs no remainder.
  constexpr std::size_t lanes = 64;
  stride_ = (order_.size() + lanes - 1) / lanes * lanes;
  counts_.resize(classes_.size() * stride_);
  for (std::size_t place = 0; place < order_.size(); ++place) add(place);
}

void MapGraphDatabase::add(std::size_t place) {
  const std::vector<GraphNode>& nodes = graphs_[order_[place]].nodes;
  if (groups_.empty() || groups_.back().nodes != nodes.size())
    groups_.push_back({nodes.size(), place, place, numbers_.size(), relations_.size()});
  ++groups_.back().end;

  const std::size_t first = numbers_.size();
  for (std::size_t c = 0; c < classes_.size(); ++c) {
    class_begins_.push_back(static_cast<std::uint8_t>(numbers_.size() - first));
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes[i].object_class != classes_[c]) continue;
      numbers_.push_back(static_cast<std::uint8_t>(i));
      log_heights_.push_back(log_height(nodes[i]));
      ++counts_[c * stride_ + place];
    }
  }
  // The class of all others has no nodes.
  class_begins_.insert(class_begins_.end(), 2, static_cast<std::uint8_t>(nodes.size()));
  for (std::size_t i = first; i < numbers_.size(); ++i) {
    for (std::size_t j = first; j < numbers_.size(); ++j)
      relations_.push_back(i == j ? same_node : relation(nodes[numbers_[i]], nodes[numbers_[j]]));
  }
}

PreparedImage MapGraphDatabase::prepare(std::span<const GraphNode> image) const {
  PreparedImage prepared;
  prepared.nodes = image.size();
  for (std::size_t i = 0; i < image.size(); ++i) {
    const auto at = std::ranges::lower_bound(classes_, image[i].object_class);
    const bool known = at != classes_.end() && *at == image[i].object_class;
    prepared.classes[i] = known ? static_cast<std::size_t>(at - classes_.begin()) : classes_.size();
    prepared.log_heights[i] = log_height(image[i]);
    for (std::size_t j = 0; j < image.size(); ++j) prepared.relations[i][j] = relation(image[i], image[j]);
  }
  return prepared;
}

PreparedGraph MapGraphDatabase::prepared(const Group& group, std::size_t place) const {
  const std::size_t within = place - group.begin;
  const std::size_t node = group.first_node + within * group.nodes;
  return {.nodes = group.nodes,
          .class_begin = class_begins_.data() + place * (classes_.size() + 2),
          .numbers = numbers_.data() + node,
          .relations = relations_.data() + group.first_relation + within * group.nodes * group.nodes,
          .log_heights = log_heights_.data() + node};
}

void MapGraphDatabase::count_matches(const PreparedImage& image, std::vector<std::uint8_t>& matched) const {
  matched.resize(std::max(matched.size(), stride_));
  std::fill_n(matched.begin(), stride_, std::uint8_t{0});
  const auto classes = std::span(image.classes).first(image.nodes);
  for (auto c = classes.begin(); c != classes.end(); ++c) {
    if (*c == classes_.size() || std::find(classes.begin(), c, *c) != c) continue;
    const auto in_image = static_cast<std::uint8_t>(std::count(c, classes.end(), *c));
    add_smaller(counts_.data() + *c * stride_, in_image, stride_, matched.data());
  }
}

void MapGraphDatabase::match(std::span<const GraphNode> image, const CoarseOptions& options, CoarseScratch& scratch,
                             std::vector<CoarsePose>& out) const {
  if (image.size() > max_image_nodes) {
    throw std::invalid_argument("image: " + std::to_string(image.size()) + " nodes, at most " +
                                std::to_string(max_image_nodes) + " are possible");
  }
  check_boxes(image, "image");
  check_options(options);
  out.clear();
  if (options.top == 0) return;

  const PreparedImage prepared_image = prepare(image);
  count_matches(prepared_image, scratch.matched);
  const auto cursor = [&](std::size_t group, std::size_t matched) {
    const double bound = coarse_score(image.size(), groups_[group].nodes, matched, full_agreement(matched), options);
    return CoarseScratch::Cursor{group, matched, bound};
  };
  auto& cursors = scratch.cursors;
  cursors.clear();
  for (std::size_t group = 0; group < groups_.size(); ++group) {
    const std::size_t matched = std::min(image.size(), groups_[group].nodes);
    if (matched >= options.min_matched) cursors.push_back(cursor(group, matched));
  }
  while (!cursors.empty()) {
    const auto next = std::ranges::max_element(cursors, {}, &CoarseScratch::Cursor::bound);
    if (out.size() == options.top && next->bound < out.back().score) break;
    visit(*next, prepared_image, options, scratch, out);
    if (next->matched > options.min_matched) {
      *next = cursor(next->group, next->matched - 1);
    } else {
      *next = cursors.back();
      cursors.pop_back();
    }
  }
}

void MapGraphDatabase::visit(const CoarseScratch::Cursor& cursor, const PreparedImage& image,
                             const CoarseOptions& options, CoarseScratch& scratch, std::vector<CoarsePose>& out) const {
  const Group& group = groups_[cursor.group];
  const auto score = [&](int agreement) {
    return coarse_score(image.nodes, group.nodes, cursor.matched, agreement, options);
  };
  const auto still_room = [&] { return out.size() < options.top; };
  // The smallest agreement that may bring a graph among the best.
  const auto needed_agreement = [&] {
    if (still_room()) return 0;
    const auto possible = std::views::iota(0, full_agreement(cursor.matched) + 1);
    return *std::ranges::partition_point(possible, [&](int a) { return score(a) < out.back().score; });
  };

  const std::uint8_t* const begin = scratch.matched.data() + group.begin;
  const std::uint8_t* const end = scratch.matched.data() + group.end;
  int needed = needed_agreement();
  for (const std::uint8_t* at = begin; (at = find_byte(at, end, cursor.matched)) != end; ++at) {
    const std::size_t place = group.begin + static_cast<std::size_t>(at - begin);
    CoarsePose pose{.graph = order_[place],
                    .score = cursor.bound,
                    .size_difference = 0.0,
                    .matched = cursor.matched,
                    .matches = {}};
    if (!still_room() && !better(pose, out.back())) continue;
    Assignment best{.agreement = needed};
    if (!improve_assignment(image, prepared(group, place), options.ties == CoarseTies::Size, scratch.assignment, best))
      continue;
    pose.score = score(best.agreement);
    pose.size_difference =
        std::ldexp(static_cast<double>(best.size_difference), -log_fraction_bits) / static_cast<double>(cursor.matched);
    pose.matches = best.matches;
    if (!still_room()) {
      if (!better(pose, out.back())) continue;
      out.pop_back();
    }
    out.insert(std::ranges::upper_bound(out, pose, better), pose);
    needed = needed_agreement();
  }
}

}  // namespace ridgeloc::solvers
