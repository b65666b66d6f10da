#include "studies/detection/detection.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "studies/detection/detection_trials.hpp"
#include "tests/support/building_study.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/simulation.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using tests::columns_of;
using tests::metric_of;
using tests::photo_study;

namespace {

std::string error_of(const std::string& text) {
  return tests::refusal_of([&] { make_plan(photo_study("detection", text)); });
}

}  // namespace

TEST_CASE("a class that the map does not have is refused with those that it has") {
  CHECK(error_of("[object]\nobject_class = \"dor\"\n")
            .find("object.object_class = \"dor\" is no class of the map \"two corridors and a room\" (allowed: any, "
                  "dispenser, ") != std::string::npos);
  CHECK(error_of("[sweep]\nobject_class = [\"any\", \"door\", \"tree\"]\n").find("\"tree\"") != std::string::npos);
  CHECK(error_of("[object]\nobject_class = \"door\"\n").empty());
  CHECK(error_of("").empty());
}

TEST_CASE("objects are the same however a block is cut") {
  const Study study = photo_study("detection", "[object]\nleast_detections = 3\n");
  const auto whole = columns_of(study, {50, 100});
  for (const TrialRange piece : {TrialRange{50, 1}, TrialRange{51, 39}, TrialRange{90, 60}}) {
    const auto part = columns_of(study, piece);
    for (std::size_t t = 0; t < piece.count; ++t) {
      const std::size_t at = static_cast<std::size_t>(piece.first) - 50 + t;
      CHECK(part[0].status[t] == whole[0].status[at]);
      for (const char* name : {"pseudorange_error_m", "range_m"}) {
        const std::size_t i = metric_of(study, name);
        CHECK(tests::same_bits(part[0].metrics[i][t], whole[0].metrics[i][at]));
      }
    }
  }
}

TEST_CASE("only objects of the class and at the distance asked for count") {
  const auto [distance, low, high] =
      GENERATE(table<std::string, double, double>({{"near", 0.5, 6.0}, {"far", 6.0, 13.5}, {"any", 0.5, 13.5}}));
  const Study study =
      photo_study("detection", "[detector]\nnear_m = 6.0\n[object]\nobject_class = \"door\"\ndistance = \"" + distance +
                                   "\"\nleast_detections = 2\n");
  const Plan plan = make_plan(study);
  const DetectionCell cell(plan.cells[0].values);
  const DetectionTrials trials(study.seed, cell);
  const std::size_t door = static_cast<std::size_t>(
      std::ranges::find(cell.photo.map->classes, "door", &sim::ObjectClass::name) - cell.photo.map->classes.begin());
  sim::Photo photo;
  for (std::uint64_t t = 0; t < 100; ++t) {
    const auto taken = trials.take(t, photo);
    REQUIRE(taken);
    const Sighting& sighting = *taken;
    CHECK(cell.photo.map->objects[sighting.view.object].object_class == door);
    CHECK(sighting.view.range_m >= low);
    CHECK(sighting.view.range_m <= high);
    CHECK(photo.detections.size() >= 2);
    CHECK(sighting.detection.has_value() == !std::isnan(sighting.pseudorange_m));
  }
}

TEST_CASE("photos whose detections lie far apart do not count") {
  const std::string widest = "[photo]\nwidest_spread_deg = 10.0\n[object]\nleast_detections = 3\n";
  const Study study = photo_study("detection", widest);
  const Plan plan = make_plan(study);
  const DetectionCell cell(plan.cells[0].values);
  const DetectionTrials trials(study.seed, cell);
  const double per_mm = cell.photo.options.camera.pixels_per_mm();
  sim::Photo photo;
  for (std::uint64_t t = 0; t < 100; ++t) {
    trials.take(t, photo);
    const auto angle_deg = [&](const sim::Detection& d) {
      return std::atan(d.box.x_px / (photo.image_distance_mm * per_mm)) * 180.0 / std::numbers::pi;
    };
    const auto [left, right] = std::ranges::minmax(photo.detections, {}, angle_deg);
    CHECK(angle_deg(right) - angle_deg(left) <= 10.0);
  }
  CHECK(tests::error_of_block(
            photo_study("detection", "[photo]\nwidest_spread_deg = 0.1\n[object]\nleast_detections = 9\n"))
            .find("9 detections within photo.widest_spread_deg") != std::string::npos);
}

TEST_CASE("what the class and the score of a detection depend on is no setting of the detector alone") {
  for (const char* name : {"false_class_rate", "score_low", "score_link"}) {
    CHECK(error_of("[detector]\n" + std::string(name) + " = 0.5\n").find(name) != std::string::npos);
  }
}

TEST_CASE("missed objects are in no population of errors") {
  const Study study = photo_study("detection", "");
  const auto columns = columns_of(study, {0, 200});
  const std::size_t errors = metric_of(study, "pseudorange_error_m");
  for (std::size_t t = 0; t < 200; ++t) CHECK(std::isnan(columns[0].metrics[errors][t]) == (columns[0].status[t] == 1));
}

TEST_CASE("there is no solver to choose, and no recount of failures") {
  CHECK(error_of("[[method]]\nsolver = \"detector\"\n").find("has no methods to choose; leave [[method]] out") !=
        std::string::npos);
  const Study study = photo_study("detection", "");
  const Plan plan = make_plan(study);
  REQUIRE(plan.header.methods.size() == 1);
  CHECK(plan.header.methods[0].label == "detector");
  const auto simulation = study.experiment->prepare(study.seed, plan.cells[0], {});
  CHECK(offered<FailureRecount>(*simulation) == nullptr);
  CHECK_THROWS_WITH(required<FailureRecount>(*study.experiment, *simulation),
                    "the experiment \"detection\" offers no recount of failures");
}

TEST_CASE("a perfect detector misses nothing and errs by nothing") {
  const Study study = photo_study(
      "detection", "[detector]\nrecall_near = 1.0\nrecall_far = 1.0\nedge_sigma = 0.0\noutlier_rate = 0.0\n");
  const auto columns = columns_of(study, {0, 200});
  for (std::size_t t = 0; t < 200; ++t) {
    CHECK(columns[0].status[t] == 0);
    CHECK(columns[0].metrics[metric_of(study, "pseudorange_error_m")][t] < 1e-12);
  }
}

TEST_CASE("what a map never shows is refused with what was asked for") {
  const Study study =
      photo_study("detection", "[object]\nleast_detections = 12\n[building]\nmap = { random = 1, objects = 5 }\n");
  CHECK(tests::error_of_block(study).find("none shows an object with object.object_class = \"any\", object.distance = "
                                          "\"any\" and 12 detections") != std::string::npos);
}

TEST_CASE("a photo that shows more objects that count than can be told apart is crowded") {
  // 200 objects on a floor: some photos show more than 24 of them.
  const Study study =
      photo_study("detection", "[photo]\nfarthest_m = 1000.0\n[building]\nmap = { random = 1, objects = 200 }\n");
  constexpr std::size_t photos = 200;
  const auto columns = columns_of(study, {0, photos});
  const auto& events = study.experiment->schema().events;
  const auto crowded =
      static_cast<std::uint8_t>(std::ranges::find(events, "crowded", &results::EventInfo::name) - events.begin());
  const auto count = std::ranges::count(columns[0].status, crowded);
  CHECK(count > 0);
  CHECK(count < static_cast<std::ptrdiff_t>(photos));
  for (std::size_t t = 0; t < photos; ++t) {
    if (columns[0].status[t] == crowded) CHECK(std::isnan(columns[0].metrics[metric_of(study, "range_m")][t]));
  }
}
