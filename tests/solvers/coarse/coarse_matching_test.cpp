#include "solvers/coarse/coarse_matching.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <thread>
#include <tuple>
#include <vector>

#include "tests/support/catch.hpp"

using namespace ridgeloc;
using solvers::CoarseOptions;
using solvers::CoarsePose;
using solvers::CoarseTies;
using solvers::GraphNode;
using solvers::MapGraph;

namespace {

constexpr std::uint8_t none = solvers::unmatched_node;

std::size_t integer(std::mt19937_64& engine, std::size_t low, std::size_t high) {
  return low + engine() % (high - low + 1);
}

/// Nodes on a coarse grid, so that equal relations, equal scores and equal heights are frequent.
std::vector<GraphNode> random_nodes(std::mt19937_64& engine, std::size_t count, std::size_t classes) {
  std::vector<GraphNode> nodes(count);
  for (GraphNode& node : nodes) {
    node = {.object_class = static_cast<std::uint32_t>(10 * integer(engine, 1, classes)),
            .x_px = 100.0 * static_cast<double>(integer(engine, 0, 5)),
            .y_px = 100.0 * static_cast<double>(integer(engine, 0, 5)),
            .width_px = 100.0 * static_cast<double>(integer(engine, 1, 3)),
            .height_px = 100.0 * static_cast<double>(integer(engine, 1, 3))};
  }
  return nodes;
}

MapGraph graph_of(std::vector<GraphNode> nodes) {
  std::vector<std::size_t> objects(nodes.size());
  return {.nodes = std::move(nodes), .objects = std::move(objects), .x_m = 0.0, .y_m = 0.0, .heading_rad = 0.0};
}

/// An assignment by the definitions. The size difference is a sum of whole numbers, so that ties are exact.
struct Judged {
  std::size_t matched = 0;
  int agreement = 0;
  std::int64_t size_sum = 0;
  double score = 0.0;

  double size_difference() const {
    return std::ldexp(static_cast<double>(size_sum), -32) / static_cast<double>(matched);
  }
};

Judged judge(const std::vector<GraphNode>& image, const std::vector<GraphNode>& graph,
             const solvers::NodeMatches& matches, const CoarseOptions& options) {
  const auto side = [](double from, double to, double size_from, double size_to) {
    const double band = 0.5 * (0.5 * (size_from + size_to));
    return std::abs(to - from) <= band ? 0 : to < from ? -1 : 1;
  };
  const auto lr = [&](const GraphNode& a, const GraphNode& b) { return side(a.x_px, b.x_px, a.width_px, b.width_px); };
  const auto ud = [&](const GraphNode& a, const GraphNode& b) {
    return side(a.y_px, b.y_px, a.height_px, b.height_px);
  };
  const auto log_height = [](const GraphNode& a) { return std::llround(std::ldexp(std::log(a.height_px), 32)); };
  Judged judged;
  double pairs = 0.0;
  double agreement = 0.0;
  for (std::size_t i = 0; i < image.size(); ++i) {
    if (matches[i] == none) continue;
    const GraphNode& k = graph[matches[i]];
    ++judged.matched;
    judged.size_sum += std::abs(log_height(image[i]) - log_height(k));
    for (std::size_t j = 0; j < i; ++j) {
      if (matches[j] == none) continue;
      const GraphNode& l = graph[matches[j]];
      const int equal = (lr(image[i], image[j]) == lr(k, l) ? 1 : 0) + (ud(image[i], image[j]) == ud(k, l) ? 1 : 0);
      judged.agreement += equal;
      agreement += 0.5 * equal;
      pairs += 1.0;
    }
  }
  const auto matched = static_cast<double>(judged.matched);
  judged.score =
      (matched + (pairs > 0.0 ? options.agreement_weight * agreement / pairs : 0.0)) /
      (static_cast<double>(image.size()) + options.unmatched_penalty * (static_cast<double>(graph.size()) - matched));
  return judged;
}

/// Calls `visit` with every assignment that is class-consistent and injective, maximal or not.
template <class Visit>
void for_each_assignment(const std::vector<GraphNode>& image, const std::vector<GraphNode>& graph, Visit visit) {
  solvers::NodeMatches matches;
  matches.fill(none);
  std::vector<bool> used(graph.size());
  const auto descend = [&](const auto& self, std::size_t i) -> void {
    if (i == image.size()) return visit(matches);
    for (std::size_t k = 0; k < graph.size(); ++k) {
      if (used[k] || graph[k].object_class != image[i].object_class) continue;
      used[k] = true;
      matches[i] = static_cast<std::uint8_t>(k);
      self(self, i + 1);
      used[k] = false;
    }
    matches[i] = none;
    self(self, i + 1);
  };
  descend(descend, 0);
}

/// Of a quotient of sums of a few numbers.
constexpr double rounding = 1e-14;

/// Of all assignments to a graph, the best score, and the best one by matches, agreement and size difference.
struct Exhaustive {
  double best_score = 0.0;
  Judged best;
};

Exhaustive search_exhaustively(const std::vector<GraphNode>& image, const std::vector<GraphNode>& graph,
                               const CoarseOptions& options) {
  Exhaustive found;
  for_each_assignment(image, graph, [&](const solvers::NodeMatches& matches) {
    Judged judged = judge(image, graph, matches, options);
    if (judged.matched == 0) return;
    if (options.ties == CoarseTies::Order) judged.size_sum = 0;
    found.best_score = std::max(found.best_score, judged.score);
    const auto rank = [](const Judged& of) { return std::tuple(of.matched, of.agreement, -of.size_sum); };
    if (rank(judged) > rank(found.best)) found.best = judged;
  });
  return found;
}

/// The `top` best graphs by exhaustive search of each, of those with enough matches.
std::vector<std::size_t> scan_exhaustively(const std::vector<MapGraph>& graphs, const std::vector<GraphNode>& image,
                                           const CoarseOptions& options) {
  std::vector<std::tuple<double, double, std::size_t>> ranks;
  for (std::size_t g = 0; g < graphs.size(); ++g) {
    const Judged best = search_exhaustively(image, graphs[g].nodes, options).best;
    if (best.matched < options.min_matched) continue;
    // Equal scores are equal numbers, which they are not in `Judged`.
    const double score = coarse_score(image.size(), graphs[g].nodes.size(), best.matched, best.agreement, options);
    ranks.emplace_back(-score, best.size_difference(), g);
  }
  std::ranges::sort(ranks);
  std::vector<std::size_t> best;
  for (std::size_t i = 0; i < std::min(options.top, ranks.size()); ++i) best.push_back(std::get<2>(ranks[i]));
  return best;
}

CoarseOptions random_options(std::mt19937_64& engine) {
  return {.agreement_weight = static_cast<double>(integer(engine, 0, 4)) / 4.0,
          .unmatched_penalty = static_cast<double>(integer(engine, 0, 4)) / 8.0,
          .top = integer(engine, 1, 12),
          .min_matched = integer(engine, 1, 4),
          .ties = integer(engine, 0, 1) == 0 ? CoarseTies::Size : CoarseTies::Order};
}

std::vector<CoarsePose> match(const solvers::MapGraphDatabase& database, const std::vector<GraphNode>& image,
                              const CoarseOptions& options) {
  solvers::CoarseScratch scratch;
  std::vector<CoarsePose> poses;
  database.match(image, options, scratch, poses);
  return poses;
}

bool same(const CoarsePose& a, const CoarsePose& b) {
  return a.graph == b.graph && a.score == b.score && a.size_difference == b.size_difference && a.matched == b.matched &&
         a.matches == b.matches;
}

}  // namespace

TEST_CASE("relations: left, right, up, down, and a dead band of half a box") {
  const GraphNode a{.object_class = 1, .x_px = 100.0, .y_px = 100.0, .width_px = 40.0, .height_px = 20.0};
  const auto at = [](double x, double y) {
    return GraphNode{.object_class = 2, .x_px = x, .y_px = y, .width_px = 20.0, .height_px = 60.0};
  };
  // Half of the mean width is 15, half of the mean height 20.
  const auto lr = [&](const GraphNode& b) { return static_cast<int>(relation(a, b) & 3U) - 1; };
  const auto ud = [&](const GraphNode& b) { return static_cast<int>(relation(a, b) >> 2U) - 1; };
  CHECK(lr(at(116.0, 100.0)) == 1);
  CHECK(lr(at(115.0, 100.0)) == 0);
  CHECK(lr(at(85.0, 100.0)) == 0);
  CHECK(lr(at(84.0, 100.0)) == -1);
  CHECK(ud(at(100.0, 121.0)) == 1);
  CHECK(ud(at(100.0, 120.0)) == 0);
  CHECK(ud(at(100.0, 80.0)) == 0);
  CHECK(ud(at(100.0, 79.0)) == -1);
}

TEST_CASE("a score worked by hand") {
  const auto node = [](std::uint32_t object_class, double x, double y) {
    return GraphNode{.object_class = object_class, .x_px = x, .y_px = y, .width_px = 10.0, .height_px = 10.0};
  };
  // Of the door, bin and lamp, the bin lies on the other side of the door: LR of door and bin differs, LR of bin and
  // lamp differs, so 4 of 6 relations agree. A second lamp and a table are unmatched in the graph, a sign in the image.
  const std::vector<GraphNode> image = {node(1, 0, 0), node(2, 100, 0), node(3, 50, -100), node(9, 0, 200)};
  const MapGraph graph =
      graph_of({node(2, -100, 0), node(3, 50, -100), node(1, 0, 0), node(4, 0, 50), node(3, 50, 100)});
  const auto poses = match(solvers::MapGraphDatabase({graph}), image, {});
  REQUIRE(poses.size() == 1);
  CHECK(poses[0].score == Approx((3.0 + 4.0 / 6.0) / (4.0 + 0.25 * 2.0)).epsilon(rounding));
  CHECK(poses[0].matched == 3);
  CHECK(poses[0].size_difference == 0.0);
  CHECK(poses[0].matches[0] == 2);
  CHECK(poses[0].matches[1] == 0);
  CHECK(poses[0].matches[2] == 1);
  CHECK(std::count(poses[0].matches.begin(), poses[0].matches.end(), none) == solvers::max_image_nodes - 3);
}

TEST_CASE("no assignment, maximal or not, scores more than the one found, and ties go to sizes") {
  std::mt19937_64 engine(1);
  int found = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::size_t classes = integer(engine, 1, 4);
    const auto image = random_nodes(engine, integer(engine, 0, 5), classes);
    const auto graph = random_nodes(engine, integer(engine, 0, 6), classes);
    CoarseOptions options = random_options(engine);
    options.min_matched = 1;
    const auto poses = match(solvers::MapGraphDatabase({graph_of(graph)}), image, options);
    const Exhaustive expected = search_exhaustively(image, graph, options);
    CAPTURE(round);
    REQUIRE(poses.size() == (expected.best.matched > 0 ? 1 : 0));
    if (poses.empty()) continue;
    ++found;
    const CoarsePose& pose = poses[0];
    CHECK(std::abs(pose.score - expected.best_score) <= rounding);
    CHECK(pose.matched == expected.best.matched);
    // Logarithms may be rounded to one unit of 2^-32 up or down.
    CHECK(std::abs(pose.size_difference - expected.best.size_difference()) <= 0x1p-30);
    bool allowed = false;
    for_each_assignment(image, graph, [&](const solvers::NodeMatches& m) { allowed = allowed || m == pose.matches; });
    CHECK(allowed);
    CHECK(judge(image, graph, pose.matches, options).agreement == expected.best.agreement);
  }
  CHECK(found > 1500);
}

TEST_CASE("the best poses are those of an exhaustive scan, ties included") {
  std::mt19937_64 engine(2);
  std::size_t ties = 0;
  for (int round = 0; round < 300; ++round) {
    const std::size_t classes = integer(engine, 1, 5);
    std::vector<MapGraph> graphs;
    while (graphs.size() < 60) {
      // Every fourth is a copy.
      const bool copy = !graphs.empty() && engine() % 4 == 0;
      auto nodes = copy ? graphs[integer(engine, 0, graphs.size() - 1)].nodes
                        : random_nodes(engine, integer(engine, 0, 6), classes);
      graphs.push_back(graph_of(std::move(nodes)));
    }
    const auto image = random_nodes(engine, integer(engine, 1, 5), classes + 1);
    const CoarseOptions options = random_options(engine);
    const auto poses = match(solvers::MapGraphDatabase(graphs), image, options);
    std::vector<std::size_t> found;
    for (const CoarsePose& pose : poses) found.push_back(pose.graph);
    for (std::size_t i = 1; i < poses.size(); ++i) ties += poses[i].score == poses[i - 1].score ? 1 : 0;
    CAPTURE(round);
    CHECK(found == scan_exhaustively(graphs, image, options));
  }
  CHECK(ties > 100);
}

TEST_CASE("large graphs with repeated classes: a database finds what its graphs find alone") {
  std::mt19937_64 engine(3);
  for (int round = 0; round < 20; ++round) {
    std::vector<MapGraph> graphs;
    while (graphs.size() < 150) graphs.push_back(graph_of(random_nodes(engine, integer(engine, 0, 15), 8)));
    const auto image = random_nodes(engine, integer(engine, 3, 7), 8);
    const CoarseOptions options = random_options(engine);
    std::vector<CoarsePose> alone;
    for (std::size_t g = 0; g < graphs.size(); ++g) {
      for (CoarsePose pose : match(solvers::MapGraphDatabase({graphs[g]}), image, options)) {
        pose.graph = g;
        alone.push_back(pose);
      }
    }
    std::ranges::stable_sort(alone, {},
                             [](const CoarsePose& pose) { return std::tuple(-pose.score, pose.size_difference); });
    alone.resize(std::min(alone.size(), options.top));
    CAPTURE(round);
    CHECK(std::ranges::equal(match(solvers::MapGraphDatabase(graphs), image, options), alone, same));
  }
}

TEST_CASE("of equal assignments the first counts, the rarest class being matched first") {
  const auto node = [](std::uint32_t object_class, double x) {
    return GraphNode{.object_class = object_class, .x_px = x, .y_px = 0.0, .width_px = 10.0, .height_px = 10.0};
  };
  // Three doors in one place and two bins in another; the image has one bin more.
  const MapGraph graph = graph_of({node(1, 100), node(1, 100), node(1, 100), node(2, 50), node(2, 50), node(3, 0)});
  const std::vector<GraphNode> image = {node(1, 100), node(2, 50), node(2, 50), node(2, 50), node(3, 0)};
  for (const CoarseTies ties : {CoarseTies::Size, CoarseTies::Order}) {
    const auto poses = match(solvers::MapGraphDatabase({graph}), image, {.ties = ties});
    REQUIRE(poses.size() == 1);
    const auto& matches = poses[0].matches;
    CHECK(std::vector<int>(matches.begin(), matches.begin() + 5) == std::vector<int>{0, 3, 4, none, 5});
  }
}

TEST_CASE("six lamps of twelve") {
  std::mt19937_64 engine(4);
  const auto graph = random_nodes(engine, 12, 1);
  std::vector<GraphNode> image(graph.begin(), graph.begin() + 6);
  CoarseOptions options;
  image[0].x_px += 250.0;
  image[3].y_px += 250.0;
  const auto poses = match(solvers::MapGraphDatabase({graph_of(graph)}), image, options);
  const Exhaustive expected = search_exhaustively(image, graph, options);
  REQUIRE(poses.size() == 1);
  CHECK(std::abs(poses[0].score - expected.best_score) <= rounding);
}

TEST_CASE("a match depends on its arguments alone: any thread, any scratch, any order") {
  std::mt19937_64 engine(5);
  std::vector<MapGraph> graphs;
  while (graphs.size() < 400) graphs.push_back(graph_of(random_nodes(engine, integer(engine, 0, 12), 6)));
  const solvers::MapGraphDatabase database(graphs);
  std::vector<std::vector<GraphNode>> images;
  std::vector<std::vector<CoarsePose>> expected;
  for (int i = 0; i < 60; ++i) {
    images.push_back(random_nodes(engine, integer(engine, 0, 7), 7));
    expected.push_back(match(database, images.back(), {}));
  }
  std::vector<int> wrong(4);
  std::vector<std::jthread> threads;
  for (std::size_t t = 0; t < wrong.size(); ++t) {
    threads.emplace_back([&, t] {
      solvers::CoarseScratch scratch;
      std::vector<CoarsePose> poses;
      for (std::size_t i = 0; i < images.size(); ++i) {
        const std::size_t image = t % 2 == 0 ? i : images.size() - 1 - i;
        database.match(images[image], {}, scratch, poses);
        wrong[t] += std::ranges::equal(poses, expected[image], same) ? 0 : 1;
      }
    });
  }
  threads.clear();
  CHECK(wrong == std::vector<int>(4));
}

TEST_CASE("little to match") {
  std::mt19937_64 engine(6);
  const auto nodes = random_nodes(engine, 5, 1);
  CHECK(match(solvers::MapGraphDatabase({}), nodes, {}).empty());
  CHECK(match(solvers::MapGraphDatabase({graph_of({})}), nodes, {}).empty());
  const solvers::MapGraphDatabase database({graph_of(nodes)});
  CHECK(match(database, {}, {}).empty());
  CHECK(match(database, {nodes[0], nodes[1]}, {}).empty());
  CHECK(match(database, {nodes[0], nodes[1], nodes[2]}, {}).size() == 1);
  CHECK(match(database, nodes, {.top = 0}).empty());
  // One match has no pair that could agree.
  const auto one = match(database, {nodes[0]}, {.min_matched = 1});
  REQUIRE(one.size() == 1);
  CHECK(one[0].score == 1.0 / (1.0 + 0.25 * 4.0));
}

TEST_CASE("what cannot be matched is refused") {
  std::mt19937_64 engine(7);
  const auto nodes = random_nodes(engine, 5, 2);
  const solvers::MapGraphDatabase database({graph_of(nodes)});
  auto flat = nodes;
  flat[2].height_px = 0.0;
  auto nowhere = nodes;
  nowhere[1].x_px = std::numeric_limits<double>::quiet_NaN();
  auto no_objects = graph_of(nodes);
  no_objects.objects.clear();
  using Error = std::invalid_argument;
  CHECK_THROWS_AS(solvers::MapGraphDatabase({graph_of(flat)}), Error);
  CHECK_THROWS_AS(solvers::MapGraphDatabase({no_objects}), Error);
  CHECK_THROWS_AS(solvers::MapGraphDatabase({graph_of(random_nodes(engine, solvers::max_graph_nodes + 1, 2))}), Error);
  CHECK_THROWS_AS(match(database, flat, {}), Error);
  CHECK_THROWS_AS(match(database, nowhere, {}), Error);
  CHECK_THROWS_AS(match(database, random_nodes(engine, solvers::max_image_nodes + 1, 2), {}), Error);
  CHECK_THROWS_AS(match(database, nodes, {.agreement_weight = 1.5}), Error);
  CHECK_THROWS_AS(match(database, nodes, {.unmatched_penalty = -0.5}), Error);
  CHECK_THROWS_AS(match(database, nodes, {.min_matched = 0}), Error);
}

TEST_CASE("as many nodes as are possible") {
  std::mt19937_64 engine(8);
  const auto graph = random_nodes(engine, solvers::max_graph_nodes, 100);
  const std::vector<GraphNode> image(graph.end() - solvers::max_image_nodes, graph.end());
  const auto poses = match(solvers::MapGraphDatabase({graph_of(graph)}), image, {});
  REQUIRE(poses.size() == 1);
  CHECK(poses[0].matched == solvers::max_image_nodes);
  CHECK(poses[0].score == (16.0 + 1.0) / (16.0 + 0.25 * 239.0));
  CHECK(poses[0].size_difference == 0.0);
}
