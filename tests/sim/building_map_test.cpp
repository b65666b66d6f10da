#include "sim/building_map.hpp"

#include <algorithm>

#include "core/random.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hall.hpp"

using namespace ridgeloc;
using sim::PlanPoint;
using tests::object_at;

namespace {

/// A corridor, a branch that touches it, and a room behind a wall of 0.2 m with a doorway.
sim::BuildingMap floor() {
  sim::BuildingMap map;
  map.areas = {
      {"corridor", {0.0, 10.0}, {0.0, 2.0}}, {"branch", {4.0, 6.0}, {2.0, 8.0}}, {"room", {7.0, 10.0}, {2.2, 5.0}}};
  map.openings = {{"doorway", {8.0, 9.0}, {2.0, 2.2}}};
  return map;
}

/// Whether two places see each other; both must agree.
bool sees(const sim::BuildingMap& map, const PlanPoint& a, const PlanPoint& b) {
  const bool there = map.sees(a, b);
  CHECK(map.sees(b, a) == there);
  return there;
}

}  // namespace

TEST_CASE("one sees within an area and where areas touch, up to their corners") {
  const sim::BuildingMap map = floor();
  CHECK(sees(map, {1, 1}, {9, 0.5}));
  CHECK(sees(map, {4.5, 1}, {5.5, 7}));
  CHECK_FALSE(sees(map, {1, 1}, {5, 7}));
  // Along the outer corner (4, 2), and a hundredth to either side of it.
  CHECK(sees(map, {3, 1}, {5, 3}));
  CHECK(sees(map, {3, 0.99}, {5, 2.99}));
  CHECK_FALSE(sees(map, {3, 1.01}, {5, 3.01}));
}

TEST_CASE("one sees along a border, and a place sees itself") {
  const sim::BuildingMap map = floor();
  CHECK(sees(map, {0, 2}, {10, 2}));
  CHECK(sees(map, {4, 0.5}, {4, 8}));
  CHECK(sees(map, {1, 1}, {1, 1}));
}

TEST_CASE("what is neither area nor opening is wall") {
  const sim::BuildingMap map = floor();
  CHECK_FALSE(sees(map, {7.2, 1}, {7.2, 3}));
  CHECK(sees(map, {8.5, 1}, {8.5, 4}));
  CHECK(sees(map, {7.0, 1}, {9.5, 3}));
  CHECK_FALSE(sees(map, {5, 1.9}, {9.9, 2.3}));
  // Places outside see nothing.
  CHECK_FALSE(sees(map, {5, 9}, {5, 7}));
  CHECK_FALSE(sees(map, {5, 9}, {5, 9}));
  sim::BuildingMap closed = map;
  closed.openings.clear();
  CHECK_FALSE(sees(closed, {8.5, 1}, {8.5, 4}));
}

TEST_CASE("rounding opens no gap between areas that touch") {
  sim::BuildingMap map;
  for (int i = 0; i < 20; ++i) map.areas.push_back({"strip", {0.1 * i, 0.1 * (i + 1)}, {0.0, 2.0}});
  for (int i = 0; i < 50; ++i) {
    const double y = 0.04 * i;
    CHECK(sees(map, {0.05, 0.3}, {1.95, y}));
    CHECK(sees(map, {0.0, y}, {2.0, 1.7}));
  }
}

TEST_CASE("a wall within an area hides what is behind it") {
  sim::BuildingMap map = floor();
  map.walls = {{{3.0, 0.0}, {3.0, 1.5}}};
  CHECK_FALSE(sees(map, {1, 1}, {5, 1}));
  CHECK(sees(map, {1, 1.8}, {5, 1.8}));
  CHECK(sees(map, {1, 1}, {2.9, 1}));
  CHECK(sees(map, {3, 0.2}, {3, 1.9}));  // along it
}

TEST_CASE("what hangs on a wall is seen from both of its sides") {
  sim::BuildingMap map = floor();
  map.walls = {{{3.0, 0.0}, {3.0, 1.5}}};
  CHECK(sees(map, {1, 1}, {3, 1}));
  CHECK(sees(map, {5, 1}, {3, 1}));
}

TEST_CASE("nothing shows between walls that meet") {
  sim::BuildingMap map = floor();
  map.walls = {{{3.0, 0.0}, {3.0, 1.0}}, {{3.0, 1.0}, {3.0, 2.0}}};
  CHECK_FALSE(sees(map, {1, 1}, {5, 1}));
  CHECK_FALSE(sees(map, {2, 0.5}, {4, 1.5}));
}

TEST_CASE("inside is what areas hold, borders included; a doorway is not") {
  const sim::BuildingMap map = floor();
  CHECK(map.is_inside({0, 0}));
  CHECK(map.is_inside({10, 2}));
  CHECK(map.is_inside({5, 7.9}));
  CHECK_FALSE(map.is_inside({8.5, 2.1}));
  CHECK_FALSE(map.is_inside({-0.001, 1}));
  CHECK_FALSE(map.is_inside({3, 2.001}));
}

TEST_CASE("rectangles overlap where their insides meet") {
  const sim::Rectangle a{"a", {0.0, 2.0}, {0.0, 2.0}};
  const auto meets = [&](double x, double y) {
    const sim::Rectangle b{"b", {x, x + 1.0}, {y, y + 1.0}};
    CHECK(overlap(b, a) == overlap(a, b));
    return overlap(a, b);
  };
  CHECK(meets(0.5, 0.5));
  CHECK(meets(1.9, -0.9));
  CHECK_FALSE(meets(2.0, 0.5));  // a common border
  CHECK_FALSE(meets(0.5, -1.0));
  CHECK_FALSE(meets(2.0, 2.0));  // a common corner
  CHECK_FALSE(meets(3.0, 0.5));
}

TEST_CASE("objects overlap where both their widths and their heights meet") {
  const sim::MapObject table = object_at(0, 0, 0.4, 1.2, 0.8);
  const auto meets = [&](double x, double y, double z) { return overlap(table, object_at(x, y, z, 0.4, 0.4)); };
  CHECK(meets(0.5, 0.5, 0.5));
  CHECK(meets(0.0, 0.79, 0.4));
  CHECK_FALSE(meets(0.0, 0.81, 0.4));
  CHECK_FALSE(meets(0.6, 0.6, 0.4));   // 0.85 m away
  CHECK_FALSE(meets(0.0, 0.0, 1.01));  // a clock above the table
  CHECK(meets(0.0, 0.0, 0.99));
}

TEST_CASE("the first of many overlaps is the one that comparing every pair finds") {
  const core::Stream stream(7, "objects");
  for (std::uint64_t round = 0; round < 200; ++round) {
    // Long in x, y or z; the more they are the more overlap.
    std::array<double, 3> lengths = {3.0, 3.0, 3.0};
    lengths[round % 3] = 60.0;
    std::vector<sim::MapObject> objects;
    for (std::uint64_t i = 0; i < 2 + round / 5; ++i) {
      const auto u = core::uniform_triple(stream.block(round, 2 * i));
      const auto w = core::uniform_triple(stream.block(round, 2 * i + 1));
      objects.push_back(object_at(lengths[0] * u[0], lengths[1] * u[1], lengths[2] * u[2], 2.0 * w[0], w[1]));
    }
    std::optional<std::array<std::size_t, 2>> expected;
    for (std::size_t i = 0; i < objects.size() && !expected; ++i) {
      for (std::size_t j = 0; j < i && !expected; ++j) {
        if (overlap(objects[i], objects[j])) expected = {{i, j}};
      }
    }
    CAPTURE(round);
    CHECK(sim::first_overlap(objects) == expected);
  }
  CHECK_FALSE(sim::first_overlap({}));
  CHECK_FALSE(sim::first_overlap({object_at(0, 0, 0)}));
}

TEST_CASE("walls are the borders that touch nothing, and the map's own") {
  sim::BuildingMap map;
  map.areas = {{"left", {0, 4}, {0, 2}}, {"right", {4, 6}, {1, 2}}, {"above", {0, 4}, {3, 5}}};
  map.openings = {{"door", {1, 2}, {2, 3}}};
  map.walls = {{{1, 1}, {2, 1}}};
  const std::vector<sim::Wall> walls = sim::all_walls(map);
  const auto has = [&](const sim::Wall& wall) { return std::ranges::find(walls, wall) != walls.end(); };
  CHECK(has({{1, 1}, {2, 1}}));
  CHECK(has({{0, 0}, {4, 0}}));
  CHECK(has({{0, 2}, {1, 2}}));  // beside the door
  CHECK(has({{2, 2}, {4, 2}}));
  CHECK(has({{4, 0}, {4, 1}}));  // below the opening to the right
  CHECK_FALSE(has({{4, 0}, {4, 2}}));
  CHECK(has({{1, 2}, {1, 3}}));  // sides of the door
  CHECK(has({{2, 2}, {2, 3}}));
  // 1 of its own; left 1 + 2 + 1 + 1, right 3, above 2 + 1 + 2, door 2.
  CHECK(walls.size() == 1 + 5 + 3 + 5 + 2);
  for (const sim::Wall& wall : walls) {
    const PlanPoint middle{0.5 * (wall.from_m[0] + wall.to_m[0]), 0.5 * (wall.from_m[1] + wall.to_m[1])};
    const double dx = wall.to_m[1] - wall.from_m[1];
    const double dy = wall.from_m[0] - wall.to_m[0];
    CHECK_FALSE(map.sees({middle[0] - 0.1 * dx, middle[1] - 0.1 * dy}, {middle[0] + 0.1 * dx, middle[1] + 0.1 * dy}));
  }
}
