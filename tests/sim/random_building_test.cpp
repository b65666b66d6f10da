#include "sim/random_building.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "tests/support/catch.hpp"

using namespace ridgeloc;

TEST_CASE("a random map is a function of its options") {
  CHECK(sim::random_building({.seed = 5}) == sim::random_building({.seed = 5}));
  CHECK(sim::random_building({.seed = 5}).objects != sim::random_building({.seed = 6}).objects);
  CHECK(sim::random_building({.seed = 5}).areas != sim::random_building({.seed = 6}).areas);
}

TEST_CASE("a wing does not depend on how many there are") {
  const sim::BuildingMap one = sim::random_building({.seed = 3, .wings = 1, .objects = 40});
  const sim::BuildingMap two = sim::random_building({.seed = 3, .wings = 2, .objects = 40});
  const sim::BuildingMap four = sim::random_building({.seed = 3, .wings = 4, .objects = 40});
  REQUIRE(four.objects.size() == 160);
  REQUIRE(four.areas.size() == 12);
  REQUIRE(four.openings.size() == 4);
  CHECK(std::equal(two.areas.begin(), two.areas.end(), four.areas.begin()));
  CHECK(std::equal(two.objects.begin(), two.objects.end(), four.objects.begin()));
  // The names of a single wing do not say which it is.
  for (std::size_t i = 0; i < one.objects.size(); ++i) {
    sim::MapObject object = two.objects[i];
    CHECK(object.name == "1: " + one.objects[i].name);
    object.name = one.objects[i].name;
    CHECK(object == one.objects[i]);
  }
}

TEST_CASE("random maps stand up to the rules for maps") {
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    const sim::BuildingMap map = sim::random_building({.seed = seed, .wings = 2});
    std::set<std::string> names;
    for (std::size_t i = 0; i < map.objects.size(); ++i) {
      const sim::MapObject& object = map.objects[i];
      CHECK(map.is_inside({object.centre_m[0], object.centre_m[1]}));
      CHECK(object.width_m == map.classes[object.object_class].width_m);
      CHECK(object.height_m == map.classes[object.object_class].height_m);
      names.insert(object.name);
      for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(overlap(object, map.objects[j]));
    }
    CHECK(names.size() == 120);
    for (std::size_t i = 0; i < map.areas.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(overlap(map.areas[i], map.areas[j]));
    }
  }
}

TEST_CASE("a wing is as large as the floor of the paper, and one sees into its branch and its room") {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const sim::BuildingMap map = sim::random_building({.seed = seed, .wings = 2});
    REQUIRE(map.areas.size() == 6);
    CHECK(map.areas[0].area_m2() == Approx(2.4 * 52.0));
    CHECK(map.areas[1].area_m2() == Approx(2.4 * 33.0));
    CHECK(map.areas[2].area_m2() == Approx(7.0 * 7.0));
    const auto middle = [](const sim::Rectangle& r) {
      return sim::PlanPoint{0.5 * (r.x_m[0] + r.x_m[1]), 0.5 * (r.y_m[0] + r.y_m[1])};
    };
    for (const std::size_t beside : {std::size_t{1}, std::size_t{2}}) {
      const sim::PlanPoint there = middle(map.areas[beside]);
      CHECK(map.sees({there[0], 1.2}, there));
    }
    CHECK_FALSE(map.sees({1.0, 1.0}, {1.0, 41.0}));  // the other wing
  }
}

TEST_CASE("a wing without room for its objects is refused") {
  CHECK_THROWS_AS(sim::random_building({.objects = 5000}), std::invalid_argument);
  CHECK(sim::random_building({.objects = 0}).objects.empty());
}
