// Replays of the experiments with photos tell what their blocks report.

#include "studies/study/replay.hpp"

#include <cmath>

#include "tests/support/building_study.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using results::PlanMark;
using tests::columns_of;
using tests::count_of;
using tests::metric_of;
using tests::photo_study;
using tests::real_of;
using tests::replay_of;
using tests::table_of;
using tests::text_of;

namespace {

const std::string methods = "[[method]]\nsolver = \"ols\"\n[[method]]\nsolver = \"rrr\"\n";

std::size_t marked(const results::PlanPanel& panel, PlanMark mark) {
  std::size_t n = 0;
  for (const results::PlanPlaces& places : panel.places) n += places.mark == mark ? places.points.size() : 0;
  return n;
}

}  // namespace

TEST_CASE("a replay of a photo tells what the block reports of it") {
  const Study study = photo_study("building", methods);
  const auto columns = columns_of(study, {0, 40});
  const auto& statuses = study.experiment->schema().events;
  for (std::uint64_t trial = 0; trial < 40; ++trial) {
    CAPTURE(trial);
    const Replay replay = replay_of(study, trial);
    const auto of_photo = [&](const char* name) { return columns.back().metrics[metric_of(study, name)][trial]; };
    const auto& camera = table_of(replay.scene, "camera");
    const auto& detections = table_of(replay.scene, "detections");
    const auto& starts = table_of(replay.scene, "starts");
    CHECK(static_cast<double>(count_of(camera, 0, "visible")) == of_photo("objects_visible"));
    CHECK(static_cast<double>(detections.rows.size()) == of_photo("objects_detected"));
    CHECK(static_cast<double>(starts.rows.size()) == of_photo("start_count"));
    CHECK(count_of(table_of(replay.scene, "map"), 0, "map_graphs") == 175);
    for (std::size_t i = 0; i < starts.rows.size(); ++i) {
      // Eight headings, and starts in the order of their scores.
      const double heading = real_of(starts, i, "heading_deg") / 45.0;
      CHECK(std::fabs(heading - std::round(heading)) < 1e-12);
      CHECK((i == 0 || real_of(starts, i, "score") <= real_of(starts, i - 1, "score")));
    }
    double error = 0.0;
    for (std::size_t i = 0; i < detections.rows.size(); ++i) {
      error += std::fabs(real_of(detections, i, "pseudorange_m") - real_of(detections, i, "true_range_m"));
    }
    CHECK(error / static_cast<double>(detections.rows.size()) ==
          Approx(of_photo("pseudorange_error_m")).epsilon(1e-12));
    for (std::size_t m = 0; m < study.methods.size(); ++m) {
      const auto& tables = replay.methods[m].tables;
      const auto& outcome = table_of(tables, "outcome");
      const std::uint8_t status = columns[m].status[trial];
      const auto in_block = [&](const char* name) { return columns[m].metrics[metric_of(study, name)][trial]; };
      CHECK(replay.methods[m].label == study.methods[m].label);
      CHECK(text_of(outcome, 0, "status") == statuses[status].name);
      CHECK(table_of(tables, "ends").rows.size() == starts.rows.size());
      CHECK(static_cast<double>(count_of(outcome, 0, "inside")) == in_block("converged_starts"));
      if (status != 0) continue;
      CHECK(real_of(outcome, 0, "error_m") == in_block("error_m"));
      CHECK(real_of(outcome, 0, "iterations") == in_block("iterations"));
    }
  }
}

TEST_CASE("the drawing of a photo has a panel per method, with the starts and where they lead") {
  const Study study = photo_study("building", methods);
  for (std::uint64_t trial = 0; trial < 10; ++trial) {
    const Replay replay = replay_of(study, trial);
    const auto& plan = std::get<results::FloorPlan>(replay.drawing);
    REQUIRE(plan.panels.size() == 2);
    CHECK(plan.outlines.size() == sim::all_walls(std::get<Building>(study.fixed.at("map")).map()).size());
    for (std::size_t m = 0; m < 2; ++m) {
      const results::PlanPanel& panel = plan.panels[m];
      const auto& outcome = table_of(replay.methods[m].tables, "outcome");
      CHECK(panel.title.starts_with(study.methods[m].label + ": "));
      CHECK(marked(panel, PlanMark::Star) == 1);
      CHECK(marked(panel, PlanMark::Used) == table_of(replay.scene, "detections").rows.size());
      CHECK(marked(panel, PlanMark::Filled) == count_of(outcome, 0, "inside"));
      CHECK(marked(panel, PlanMark::Filled) + marked(panel, PlanMark::Hollow) == count_of(outcome, 0, "starts"));
      CHECK(marked(panel, PlanMark::Mean) == (count_of(outcome, 0, "inside") > 0 ? 1 : 0));
      for (const results::PlanPlaces& places : panel.places) {
        if (places.mark == PlanMark::Object) continue;  // those of the whole map
        for (const results::DrawnPoint& point : places.points) CHECK(plan.window.contains(point));
      }
    }
  }
}

TEST_CASE("starts all over the map are drawn as tiles, each of one kind") {
  const Study study = photo_study("building", "[coarse]\nstarts = \"grid\"\nstart_spacing_m = 3.0\n" + methods);
  const Replay replay = replay_of(study, 0);
  const auto& plan = std::get<results::FloorPlan>(replay.drawing);
  CHECK(plan.tile == 3.0);
  for (std::size_t m = 0; m < 2; ++m) {
    const auto& panel = plan.panels[m];
    const auto& outcome = table_of(replay.methods[m].tables, "outcome");
    const std::size_t inside = marked(panel, PlanMark::GoodTile) + marked(panel, PlanMark::WrongTile);
    CHECK(inside == count_of(outcome, 0, "inside"));
    CHECK(inside + marked(panel, PlanMark::OutsideTile) == count_of(outcome, 0, "converged"));
    CHECK(inside + marked(panel, PlanMark::OutsideTile) + marked(panel, PlanMark::LostTile) ==
          table_of(replay.scene, "starts").rows.size());
  }
}

TEST_CASE("a replay of a detection tells what the block reports of it") {
  const Study study = photo_study("detection", "");
  const auto columns = columns_of(study, {0, 60});
  const auto in_block = [&](const char* name, std::uint64_t t) {
    return columns[0].metrics[metric_of(study, name)][t];
  };
  std::size_t missed = 0;
  for (std::uint64_t trial = 0; trial < 60; ++trial) {
    CAPTURE(trial);
    const Replay replay = replay_of(study, trial);
    const auto& object = table_of(replay.scene, "object");
    CHECK(replay.methods.empty());
    const auto& outcome = table_of(replay.scene, "outcome");
    CHECK(real_of(object, 0, "true_range_m") == in_block("range_m", trial));
    CHECK(count_of(table_of(replay.scene, "camera"), 0, "visible") >= 3);
    const bool found = columns[0].status[trial] == 0;
    missed += found ? 0 : 1;
    CHECK(text_of(outcome, 0, "status") == (found ? "detected" : "missed"));
    const auto& plan = std::get<results::FloorPlan>(replay.drawing);
    REQUIRE(plan.panels.size() == 1);
    CHECK(plan.panels[0].title.starts_with(text_of(object, 0, "object") + (found ? ": detected, at " : ": missed")));
    CHECK(marked(plan.panels[0], found ? PlanMark::Filled : PlanMark::Hollow) == 1);
    CHECK(marked(plan.panels[0], found ? PlanMark::Hollow : PlanMark::Filled) == 0);
    if (!found) continue;
    CHECK(real_of(outcome, 0, "pseudorange_error_m") == in_block("pseudorange_error_m", trial));
    CHECK(std::fabs(real_of(outcome, 0, "pseudorange_m") - real_of(object, 0, "true_range_m")) ==
          in_block("pseudorange_error_m", trial));
  }
  CHECK(missed > 0);
  CHECK(missed < 40);
}
