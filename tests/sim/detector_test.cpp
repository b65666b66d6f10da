#include "sim/detector.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/support/catch.hpp"
#include "tests/support/hall.hpp"

using namespace ridgeloc;
using tests::hall;
using tests::object_at;

namespace {

constexpr std::uint64_t trials = 2000;

/// An object of the hall in a picture, 100 px wide and 200 px high.
sim::View view(std::size_t object = 0, double range_m = 5.0) {
  return {object, {300.0, -40.0, 100.0, 200.0}, range_m, range_m};
}

/// Finds everything.
sim::DetectorModel sure() {
  sim::DetectorModel model;
  model.recall_near = model.recall_far = 1.0;
  return model;
}

/// Finds everything and makes no error.
sim::DetectorModel perfect() {
  sim::DetectorModel model = sure();
  model.edge_sigma = 0.0;
  model.outlier_rate = 0.0;
  return model;
}

sim::BuildingMap map() {
  return hall({object_at(5, 0, 1.5), object_at(5, 1, 1.5, 0.5, 0.5, 1), object_at(5, 2, 1.5, 0.5, 0.5, 2)});
}

std::optional<sim::Detection> detect(const sim::DetectorModel& model, const sim::View& seen, std::uint64_t trial,
                                     const sim::BuildingMap& in = map()) {
  return sim::detect(model, in, seen, sim::detector_stream(2018), trial, 0);
}

bool same(const sim::Box& a, const sim::Box& b) {
  return a.x_px == b.x_px && a.y_px == b.y_px && a.width_px == b.width_px && a.height_px == b.height_px;
}

bool same(const sim::Detection& a, const sim::Detection& b) {
  return a.object == b.object && a.object_class == b.object_class && same(a.box, b.box) && a.score == b.score &&
         a.height_factor == b.height_factor;
}

}  // namespace

TEST_CASE("without errors a detection is the object's box, class and height") {
  for (std::uint64_t t = 0; t < 100; ++t) {
    const auto found = detect(perfect(), view(2), t);
    REQUIRE(found);
    CHECK(found->object == 2);
    CHECK(found->object_class == 2);
    CHECK(same(found->box, view().box));
    CHECK(found->height_factor == 1.0);
  }
}

TEST_CASE("how often objects are found changes no error, and a better detector finds what a worse one does") {
  sim::DetectorModel model = sure();
  model.false_class_rate = 0.3;
  model.height_sigma = 0.1;
  model.score_link = 0.5;
  sim::DetectorModel worse = model;
  worse.recall_near = 0.6;
  sim::DetectorModel worst = model;
  worst.recall_near = 0.2;
  std::size_t found_by_worst = 0;
  for (std::uint64_t t = 0; t < trials; ++t) {
    const auto all = detect(model, view(), t);
    const auto some = detect(worse, view(), t);
    const auto few = detect(worst, view(), t);
    REQUIRE(all);
    if (some) CHECK(same(*some, *all));
    if (few) CHECK(some.has_value());
    found_by_worst += few ? 1 : 0;
  }
  CHECK(found_by_worst > 0);
  CHECK(found_by_worst < trials / 2);
}

TEST_CASE("errors differ between objects, trials, pictures of a trial and seeds") {
  const sim::BuildingMap in = map();
  const auto of = [&](std::size_t object, std::uint64_t trial, std::uint64_t attempt, std::uint64_t seed) {
    return sim::detect(sure(), in, view(object), sim::detector_stream(seed), trial, attempt)->box.height_px;
  };
  const std::set<double> heights = {of(0, 0, 0, 1), of(1, 0, 0, 1), of(0, 1, 0, 1), of(0, 0, 1, 1), of(0, 0, 0, 2)};
  CHECK(heights.size() == 5);
}

TEST_CASE("recall is that of near or far, and a class may have its own") {
  sim::DetectorModel model = perfect();
  model.near_m = 8.0;
  const auto shares = [&](const sim::BuildingMap& in, std::size_t object) {
    std::array<std::size_t, 2> found{};
    for (std::uint64_t t = 0; t < 200; ++t) {
      found[0] += detect(model, view(object, 8.0), t, in) ? 1 : 0;  // 8.0 is near
      found[1] += detect(model, view(object, 8.001), t, in) ? 1 : 0;
    }
    return found;
  };
  model.recall_far = 0.0;
  CHECK(shares(map(), 0) == std::array<std::size_t, 2>{200, 0});
  sim::BuildingMap own = map();
  own.classes[1].recall = {0.0, 1.0};
  CHECK(shares(own, 0) == std::array<std::size_t, 2>{200, 0});
  CHECK(shares(own, 1) == std::array<std::size_t, 2>{0, 200});
}

TEST_CASE("a false class is one of the others, each of them at times") {
  sim::DetectorModel model = perfect();
  model.false_class_rate = 1.0;
  for (std::size_t object = 0; object < 3; ++object) {
    std::set<std::size_t> taken_for;
    for (std::uint64_t t = 0; t < 200; ++t) taken_for.insert(detect(model, view(object), t)->object_class);
    std::set<std::size_t> others = {0, 1, 2};
    others.erase(object);
    CHECK(taken_for == others);
  }
  sim::BuildingMap single = hall({object_at(5, 0, 1.5)});
  single.classes.resize(1);
  CHECK(detect(model, view(), 0, single)->object_class == 0);
}

TEST_CASE("an outlier moves the upper or the lower edge, to either side") {
  sim::DetectorModel model = perfect();
  model.outlier_rate = 1.0;
  std::array<std::size_t, 4> cases{};
  for (std::uint64_t t = 0; t < trials; ++t) {
    const sim::Box box = detect(model, view(), t)->box;
    const double upper = (box.y_px - 0.5 * box.height_px) - (-40.0 - 100.0);
    const double lower = (box.y_px + 0.5 * box.height_px) - (-40.0 + 100.0);
    const bool is_upper = std::fabs(upper) > std::fabs(lower);
    constexpr double rounding = 1e-11;  // of sums of a few hundred pixels
    CHECK(std::min(std::fabs(upper), std::fabs(lower)) < rounding);
    const double size = std::max(std::fabs(upper), std::fabs(lower)) / 200.0;
    CHECK((size >= 0.15 - rounding && size <= 0.40 + rounding));
    CHECK(box.width_px == 100.0);
    ++cases[(is_upper ? 0U : 2U) + ((is_upper ? upper : lower) < 0.0 ? 0U : 1U)];
  }
  for (const std::size_t count : cases) CHECK(count > trials / 5);
}

TEST_CASE("a rate of outliers leaves the other boxes as they are") {
  sim::DetectorModel none = sure();
  none.outlier_rate = 0.0;
  std::size_t changed = 0;
  for (std::uint64_t t = 0; t < trials; ++t) {
    const sim::Box box = detect(sure(), view(), t)->box;
    const sim::Box plain = detect(none, view(), t)->box;
    CHECK(box.width_px == plain.width_px);
    changed += same(box, plain) ? 0 : 1;
  }
  CHECK(changed > trials / 20);
  CHECK(changed < trials / 5);
}

TEST_CASE("boxes and heights keep a tenth of their size, whatever the errors") {
  sim::DetectorModel model = sure();
  model.edge_sigma = 0.5;
  model.outlier_rate = 1.0;
  model.outlier_size = {1.0, 1.0};
  model.height_sigma = 1.0;
  double lowest = 1e9;
  double smallest_factor = 1e9;
  for (std::uint64_t t = 0; t < trials; ++t) {
    const sim::Detection d = *detect(model, view(), t);
    lowest = std::min(lowest, d.box.height_px);
    smallest_factor = std::min(smallest_factor, d.height_factor);
  }
  CHECK(lowest == 20.0);
  CHECK(smallest_factor == 0.1);
}

TEST_CASE("scores lie between the lowest and 1") {
  sim::DetectorModel model = sure();
  model.score_low = 0.4;
  for (const double link : {0.0, 0.5, 1.0}) {
    model.score_link = link;
    double low = 1.0;
    double high = 0.0;
    for (std::uint64_t t = 0; t < trials; ++t) {
      const double score = detect(model, view(), t)->score;
      low = std::min(low, score);
      high = std::max(high, score);
    }
    CHECK(low >= 0.4);
    CHECK(low < 0.42);
    CHECK(high <= 1.0);
    CHECK(high > 0.98);
  }
}

TEST_CASE("linked scores fall as the error of the box' height grows") {
  sim::DetectorModel model = sure();
  model.score_link = 1.0;
  std::vector<std::array<double, 2>> pairs;
  for (std::uint64_t t = 0; t < trials; ++t) {
    const sim::Detection d = *detect(model, view(), t);
    pairs.push_back({std::fabs(d.box.height_px - 200.0), d.score});
  }
  std::ranges::sort(pairs);
  CHECK(std::ranges::is_sorted(pairs, [](const auto& a, const auto& b) { return a[1] > b[1] + 1e-12; }));
  CHECK(pairs.front()[1] > 0.99);
}
