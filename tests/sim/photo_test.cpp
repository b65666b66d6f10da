#include "sim/photo.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/random_building.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hall.hpp"

using namespace ridgeloc;
using tests::hall;
using tests::object_at;

namespace {

bool same(const sim::Photo& a, const sim::Photo& b) {
  const auto boxes = [](const sim::Photo& photo) {
    std::vector<double> values = {photo.image_distance_mm, photo.pose.heading_turns, photo.pose.position_m[0],
                                  photo.pose.position_m[1]};
    for (const sim::View& v : photo.views) values.push_back(v.box.x_px);
    for (const sim::Detection& d : photo.detections)
      values.insert(values.end(), {d.box.x_px, d.box.height_px, d.score});
    return values;
  };
  return boxes(a) == boxes(b) && a.attempts == b.attempts;
}

/// The angle between the leftmost and the rightmost detection.
double spread_deg(const sim::Photo& photo, const sim::Camera& camera) {
  const auto angle = [&](const sim::Detection& d) {
    return std::atan(d.box.x_px / (photo.image_distance_mm * camera.pixels_per_mm())) * 180.0 / std::numbers::pi;
  };
  double low = 1e9;
  double high = -1e9;
  for (const sim::Detection& d : photo.detections) {
    low = std::min(low, angle(d));
    high = std::max(high, angle(d));
  }
  return high - low;
}

}  // namespace

TEST_CASE("the photo of a trial depends on seed and trial alone") {
  const sim::BuildingMap map = sim::random_building({});
  const sim::PhotoOptions options;
  const sim::DetectorModel detector;
  const sim::PhotoTaker taker(map, options, detector, 7);
  std::vector<sim::Photo> forward(20);
  for (std::uint64_t t = 0; t < 20; ++t) REQUIRE(taker.take(t, 3, forward[t]));
  const sim::PhotoTaker again(map, options, detector, 7);
  const sim::PhotoTaker other(map, options, detector, 8);
  sim::Photo photo;
  for (std::uint64_t t = 20; t-- > 0;) {
    REQUIRE(again.take(t, 3, photo));
    CHECK(same(photo, forward[t]));
    REQUIRE(other.take(t, 3, photo));
    CHECK_FALSE(same(photo, forward[t]));
  }
}

TEST_CASE("a trial takes the first of its photos that counts") {
  const sim::BuildingMap map = sim::random_building({});
  const sim::PhotoOptions options;
  const sim::DetectorModel detector;
  const sim::PhotoTaker taker(map, options, detector, 7);
  sim::Photo photo;
  sim::Photo one;
  for (std::uint64_t t = 0; t < 20; ++t) {
    REQUIRE(taker.take(t, 4, photo));
    CHECK(photo.detections.size() == 4);
    CHECK(photo.views.size() >= 4);
    REQUIRE(taker.take_one(t, photo.attempts - 1, one));
    CHECK(same(photo, one));
    for (std::uint64_t attempt = 0; attempt + 1 < photo.attempts; ++attempt) {
      CHECK_FALSE((taker.take_one(t, attempt, one) && one.detections.size() == 4));
    }
    REQUIRE(taker.take(t, 0, photo));  // any number
    CHECK(photo.views.size() >= options.least_visible);
  }
}

TEST_CASE("the errors of an object do not depend on what else a photo shows") {
  const sim::BuildingMap map = sim::random_building({});
  sim::PhotoOptions options;
  const sim::DetectorModel detector;
  sim::PhotoOptions shorter = options;
  shorter.camera.farthest_m = 8.0;
  shorter.least_visible = options.least_visible = 0;
  const sim::PhotoTaker taker(map, options, detector, 7);
  const sim::PhotoTaker other(map, shorter, detector, 7);
  std::size_t compared = 0;
  std::size_t fewer = 0;
  sim::Photo a;
  sim::Photo b;
  for (std::uint64_t t = 0; t < 200; ++t) {
    REQUIRE(taker.take_one(t, 0, a));
    REQUIRE(other.take_one(t, 0, b));
    fewer += b.views.size() < a.views.size() ? 1 : 0;
    for (const sim::Detection& d : b.detections) {
      const auto found = std::ranges::find(a.detections, d.object, &sim::Detection::object);
      if (found == a.detections.end() || a.image_distance_mm != b.image_distance_mm) continue;
      ++compared;
      CHECK(found->box.height_px == d.box.height_px);
      CHECK(found->score == d.score);
    }
  }
  CHECK(compared > 50);
  CHECK(fewer > 20);
}

TEST_CASE("photos count up to the widest spread of their detections") {
  const sim::BuildingMap map = sim::random_building({});
  sim::PhotoOptions options;
  const sim::DetectorModel detector;
  sim::Photo photo;
  for (const double widest : {15.0, 30.0, 180.0}) {
    options.widest_spread_deg = widest;
    const sim::PhotoTaker taker(map, options, detector, 7);
    double largest = 0.0;
    for (std::uint64_t t = 0; t < 60; ++t) {
      REQUIRE(taker.take(t, 3, photo));
      largest = std::max(largest, spread_deg(photo, options.camera));
    }
    CHECK(largest <= widest);
    CHECK(largest > std::min(0.7 * widest, 35.0));
  }
}

TEST_CASE("cameras stand in areas, off their borders, and on the middle line of narrow ones") {
  sim::BuildingMap map;
  map.areas = {{"wide", {0.0, 10.0}, {0.0, 4.0}}, {"narrow", {10.0, 20.0}, {0.0, 0.8}}};
  map.classes = {{"a", 0.5, 0.5, {}}};
  map.objects = {object_at(5, 2, 1.5)};
  sim::PhotoOptions options;
  options.wall_distance_m = 0.5;
  options.least_visible = 0;
  const sim::DetectorModel detector;
  const sim::PhotoTaker taker(map, options, detector, 7);
  std::size_t narrow = 0;
  sim::Photo photo;
  for (std::uint64_t t = 0; t < 500; ++t) {
    REQUIRE(taker.take_one(t, 0, photo));
    const auto& at = photo.pose.position_m;
    CHECK(at[2] == options.height_m);
    CHECK(photo.pose.pitch_turns == 0.0);
    CHECK(photo.pose.roll_turns == 0.0);
    const bool in_narrow = at[0] > 10.0;
    narrow += in_narrow ? 1 : 0;
    if (in_narrow) {
      CHECK((at[0] >= 10.5 && at[0] <= 19.5 && at[1] == Approx(0.4)));
    } else {
      CHECK((at[0] >= 0.5 && at[0] <= 9.5 && at[1] >= 0.5 && at[1] <= 3.5));
    }
  }
  CHECK(narrow > 0);
}

TEST_CASE("what a map never shows is said to be impossible") {
  const sim::BuildingMap map = hall({object_at(5, 0, 1.5), object_at(6, 0, 1.5), object_at(7, 0, 1.5)});
  const sim::PhotoOptions options;
  const sim::DetectorModel detector;
  const sim::PhotoTaker taker(map, options, detector, 7);
  sim::Photo photo;
  CHECK(taker.take(0, 3, photo));
  CHECK_FALSE(taker.take(0, 4, photo));
}

TEST_CASE("numbers of detections come as often as in Table 1") {
  std::array<int, 8> counts{};
  for (int k = 0; k < 80; ++k) ++counts[sim::table1_detections((k + 0.5) / 80.0)];
  CHECK(counts == std::array<int, 8>{0, 0, 0, 47, 22, 7, 3, 1});
  CHECK(sim::table1_detections(1e-12) == 3);
  CHECK(sim::table1_detections(1.0 - 1e-12) == 7);
}
