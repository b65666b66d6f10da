#include "sim/field_of_view.hpp"

#include <cmath>
#include <numbers>

#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

core::ProblemBatch scene(const sim::FieldOfView& view, std::size_t points, std::size_t trials,
                         std::uint64_t first_trial = 0) {
  core::ProblemBatch problems;
  problems.reshape(points, trials);
  sim::place_objects(view, sim::SceneStreams(2018, view), first_trial, problems);
  return problems;
}

}  // namespace

TEST_CASE("objects lie in the field of view and the start at its offset") {
  sim::FieldOfView view;
  view.azimuth_deg = {-20, 40};
  view.elevation_deg = {5, 30};
  view.depth_m = {2, 3};
  view.start_offset_m = 1.5;
  const auto problems = scene(view, 4, 500);
  constexpr double rounding = 1e-12;
  for (std::size_t t = 0; t < 500; ++t) {
    for (std::size_t j = 0; j < 4; ++j) {
      const double x = problems.position(j, 0)[t];
      const double y = problems.position(j, 1)[t];
      const double z = problems.position(j, 2)[t];
      const double azimuth = std::atan2(y, x) * 180.0 / std::numbers::pi;
      const double elevation = std::atan2(z, std::hypot(x, y)) * 180.0 / std::numbers::pi;
      const double depth = std::hypot(x, y, z);
      const bool inside = -20 - rounding <= azimuth && azimuth <= 40 + rounding && 5 - rounding <= elevation &&
                          elevation <= 30 + rounding && 2 - rounding <= depth && depth <= 3 + rounding;
      CHECK(inside);
    }
    CHECK(std::hypot(problems.start(0)[t], problems.start(1)[t], problems.start(2)[t]) == Approx(1.5).epsilon(1e-15));
  }
}

TEST_CASE("three points are the first three of seven, and trials do not depend on where a batch begins") {
  const sim::FieldOfView view;
  const auto seven = scene(view, 7, 20);
  const auto three = scene(view, 3, 20);
  const auto later = scene(view, 7, 12, 8);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t t = 0; t < 20; ++t) {
      for (std::size_t j = 0; j < 3; ++j) CHECK(three.position(j, axis)[t] == seven.position(j, axis)[t]);
      CHECK(three.start(axis)[t] == seven.start(axis)[t]);
    }
    for (std::size_t t = 0; t < 12; ++t) {
      CHECK(later.position(6, axis)[t] == seven.position(6, axis)[t + 8]);
      CHECK(later.start(axis)[t] == seven.start(axis)[t + 8]);
    }
  }
}

TEST_CASE("the scene's stream depends on the field of view, and on nothing else") {
  sim::FieldOfView view;
  const auto key = [&view] { return sim::SceneStreams(2018, view).scene.key(); };
  const auto before = key();
  view.start_offset_m = 1.0;
  CHECK(key() == before);
  view.depth_m[1] = std::nextafter(view.depth_m[1], 20.0);
  CHECK(key() != before);
  view = {};
  view.depth_distribution = sim::DepthDistribution::Volume;
  CHECK(key() != before);
}
