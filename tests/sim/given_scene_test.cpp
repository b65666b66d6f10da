#include "sim/given_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/kernels.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

using Column = std::vector<double>;

const std::array<Column, 3> objects = {Column{0.1, 8.3, 8.0, 1000.7}, Column{0.0, -0.2, 6.1, 5.0},
                                       Column{2.5, 2.5, 0.3, -7.7}};
const std::array<Column, 3> cameras = {Column{1, 2, 3}, Column{4, 5, 6}, Column{0.5, 1.5, 2.5}};

sim::PositionColumns columns_of(const std::array<Column, 3>& positions) {
  return {positions[0], positions[1], positions[2]};
}

sim::GivenScene in_box() {
  return {columns_of(objects), {}, {{{-2.0, 6.0}, {1.0, 1.0}, {0.0, 3.0}}}, 5.0, false};
}

sim::GivenScene at_places() {
  return {columns_of(objects), columns_of(cameras), {}, 5.0, true};
}

struct Drawn {
  core::ProblemBatch problems;
  std::array<Column, 3> truth;

  Drawn(const sim::GivenScene& scene, const sim::Kernels& kernels, std::uint64_t first, std::size_t trials,
        double sigma_m = 0.0) {
    problems.reshape(4, trials);
    for (Column& column : truth) column.resize(trials);
    const sim::TruthColumns written = {truth[0], truth[1], truth[2]};
    const sim::GivenSceneStreams streams(2018);
    kernels.place_camera(scene, streams, first, written, problems);
    kernels.measure_ranges(sim::noise_registry()[0], {.range_sigma_m = sigma_m}, core::Stream(2018, "noise"), first,
                           problems);
    kernels.show_map(scene, streams, first, written, problems);
  }

  std::array<double, 3> camera(std::size_t t) const { return {truth[0][t], truth[1][t], truth[2][t]}; }
  double range(std::size_t j, std::size_t t) const {
    return std::hypot(objects[0][j] - truth[0][t], objects[1][j] - truth[1][t], objects[2][j] - truth[2][t]);
  }
  /// Every number of a trial.
  Column numbers(std::size_t t) const {
    Column all = {truth[0][t], truth[1][t], truth[2][t]};
    for (std::size_t axis = 0; axis < 3; ++axis) all.push_back(problems.start(axis)[t]);
    for (std::size_t j = 0; j < problems.points(); ++j) {
      for (std::size_t axis = 0; axis < 3; ++axis) all.push_back(problems.position(j, axis)[t]);
      all.push_back(problems.measured(j)[t]);
    }
    return all;
  }
};

}  // namespace

TEST_CASE("given objects lie where they are given, and ranges are measured from where the camera is") {
  for (const auto& scene : {in_box(), at_places()}) {
    const Drawn d(scene, sim::kernels_over<double>(), 7, 200);
    for (std::size_t t = 0; t < 200; ++t) {
      double squared = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (std::size_t j = 0; j < 4; ++j) CHECK(d.problems.position(j, axis)[t] == objects[axis][j]);
        const double offset = d.problems.start(axis)[t] - d.truth[axis][t];
        squared += offset * offset;
      }
      // Differences of numbers up to 1000 m, rounded.
      for (std::size_t j = 0; j < 4; ++j) CHECK(std::fabs(d.problems.measured(j)[t] - d.range(j, t)) < 1e-12);
      CHECK(std::sqrt(squared) == Approx(5.0).epsilon(1e-12));
      CHECK((d.problems.start(2)[t] == d.truth[2][t]) == scene.start_at_height);
    }
  }
}

TEST_CASE("the camera is uniform in its box") {
  constexpr std::size_t trials = 4096;
  const Drawn d(in_box(), sim::kernels_over<double>(), 0, trials);
  const auto [low, high] = std::ranges::minmax(d.truth[0]);
  CHECK(low >= -2.0);
  CHECK(high <= 6.0);
  CHECK(std::ranges::all_of(d.truth[1], [](double y) { return y == 1.0; }));
  // Means within five standard errors, side / sqrt(12 n), and a correlation of 0 within five of 1 / sqrt(n): once in a
  // million seeds not.
  double x = 0.0;
  double z = 0.0;
  double product = 0.0;
  for (std::size_t t = 0; t < trials; ++t) {
    x += (d.truth[0][t] - 2.0) / 8.0;
    z += (d.truth[2][t] - 1.5) / 3.0;
    product += 12.0 * (d.truth[0][t] - 2.0) / 8.0 * (d.truth[2][t] - 1.5) / 3.0;
  }
  const double n = trials;
  CHECK(std::fabs(x / n) < 5.0 / std::sqrt(12.0 * n));
  CHECK(std::fabs(z / n) < 5.0 / std::sqrt(12.0 * n));
  CHECK(std::fabs(product / n) < 5.0 / std::sqrt(n));
}

TEST_CASE("given places of the camera are taken with equal chances") {
  constexpr std::size_t trials = 3000;
  const Drawn d(at_places(), sim::kernels_over<double>(), 0, trials);
  std::array<std::size_t, 3> counts{};
  for (std::size_t t = 0; t < trials; ++t) {
    const auto at = static_cast<std::size_t>(d.truth[0][t]) - 1;
    REQUIRE(d.camera(t) == std::array<double, 3>{cameras[0][at], cameras[1][at], cameras[2][at]});
    ++counts[at];
  }
  // Five standard deviations of a binomial count: once in a million seeds not.
  for (const std::size_t count : counts)
    CHECK(std::fabs(static_cast<double>(count) - 1000.0) < 5.0 * std::sqrt(3000.0 * 2.0 / 9.0));
}

TEST_CASE("a scene of given objects is the same in every lane; the baseline draws the bits of the double path") {
  for (const auto& scene : {in_box(), at_places()}) {
    const Drawn reference(scene, sim::kernels_over<double>(), 40, 33, 0.3);
    for (const core::Isa isa : {core::Isa::Baseline, core::Isa::Avx2, core::Isa::Avx512}) {
      if (!core::is_supported(isa)) continue;
      INFO(core::name_of(isa));
      const Drawn whole(scene, sim::kernels(isa), 40, 33, 0.3);
      double largest = 0.0;
      for (std::size_t t = 0; t < 33; ++t) {
        const Column a = reference.numbers(t);
        const Column b = whole.numbers(t);
        for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::fabs(a[i] - b[i]));
        CHECK(Drawn(scene, sim::kernels(isa), 40 + t, 1, 0.3).numbers(0) == b);
      }
      // A few roundings of 2^-53 of lengths up to 1001 m.
      CHECK(largest <= (isa == core::Isa::Baseline ? 0.0 : 16.0 * 0x1p-53 * 1001.0));
    }
  }
}

TEST_CASE("other places of the camera are drawn by the same numbers") {
  auto wide = in_box();
  wide.box_m[0] = {-4.0, 12.0};
  const Drawn a(in_box(), sim::kernels_over<double>(), 0, 50, 0.3);
  const Drawn b(wide, sim::kernels_over<double>(), 0, 50, 0.3);
  for (std::size_t t = 0; t < 50; ++t) {
    CHECK(b.truth[0][t] == Approx(2.0 * a.truth[0][t]).margin(1e-12));
    CHECK(b.truth[2][t] == a.truth[2][t]);
    CHECK(b.problems.measured(3)[t] - b.range(3, t) == Approx(a.problems.measured(3)[t] - a.range(3, t)).margin(1e-11));
  }
}
