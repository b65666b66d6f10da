// Map graphs, starts and problems of photos, and what solvers make of them.

#include "studies/building/building_trials.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "sim/random_building.hpp"
#include "solvers/solver.hpp"
#include "studies/files/map_reader.hpp"
#include "studies/solving/audit.hpp"
#include "tests/support/building_study.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using tests::photo_study;
using tests::Photos;

namespace {

const std::string ols = "[[method]]\nsolver = \"ols\"\n";

/// A detector without errors.
const std::string perfect = R"([detector]
recall_near = 1.0
recall_far = 1.0
edge_sigma = 0.0
outlier_rate = 0.0
)";

}  // namespace

TEST_CASE("grid places divide every area evenly, as near to the spacing as its sides allow") {
  sim::BuildingMap map;
  map.areas = {{"a", {0.0, 5.0}, {0.0, 2.4}}, {"b", {10.0, 10.5}, {-1.0, 1.0}}};
  const auto places = grid_places(map, 2.0);
  // 5 m make three parts (two and a half, rounded up), 2.4 m one; half a metre makes one, 2 m one.
  REQUIRE(places.size() == 4);
  CHECK(places[0][0] == Approx(5.0 / 6.0));
  CHECK(places[2][0] == Approx(25.0 / 6.0));
  CHECK(places[2][1] == Approx(1.2));
  CHECK(places[3][0] == Approx(10.25));
  CHECK(std::fabs(places[3][1]) < 1e-15);
  CHECK(grid_places(map, 0.5).size() == 10 * 5 + 4);
  for (const double spacing : {0.3, 0.5, 2.0, 100.0})
    CHECK(grid_size(map, spacing) == grid_places(map, spacing).size());
}

TEST_CASE("the paper's map has a graph for each place and heading that shows something") {
  const sim::BuildingMap& map = find_building("paper")->map();
  CHECK(grid_places(map, 2.0).size() == 26 + 17 + 16);  // along the corridors, and in the room
  const auto graphs = map_graphs(map, {}, 1.5, 2.0, 8);
  CHECK(graphs.size() == 175);
  for (const solvers::MapGraph& graph : graphs) {
    CHECK_FALSE(graph.nodes.empty());
    REQUIRE(graph.nodes.size() == graph.objects.size());
    CHECK(map.is_inside({graph.x_m, graph.y_m}));
    for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
      CHECK(graph.nodes[i].object_class == map.objects[graph.objects[i]].object_class);
    }
  }
}

TEST_CASE("a map graph holds what a photo of the whole map shows") {
  const sim::BuildingMap map = sim::random_building({.seed = 5, .wings = 2, .objects = 80});
  const sim::Camera camera;
  std::vector<sim::View> views;
  double image_distance_mm = 0.0;
  for (const solvers::MapGraph& graph : map_graphs(map, camera, 1.5, 3.0, 4)) {
    const double turns = std::round(4.0 * graph.heading_rad / (2.0 * std::numbers::pi)) / 4.0;
    sim::take_photo(map, camera, {{graph.x_m, graph.y_m, 1.5}, turns}, views, image_distance_mm);
    REQUIRE(views.size() == graph.nodes.size());
    for (std::size_t i = 0; i < views.size(); ++i) {
      CHECK(graph.objects[i] == views[i].object);
      CHECK(graph.nodes[i].object_class == map.objects[views[i].object].object_class);
      CHECK(graph.nodes[i].x_px == views[i].box.x_px);
      CHECK(graph.nodes[i].height_px == views[i].box.height_px);
    }
  }
}

TEST_CASE("a view of more objects than a map graph takes is refused with what to change") {
  sim::BuildingMap map;
  map.name = "shelf";
  map.areas = {{"a", {0.0, 4.0}, {0.0, 4.0}}};
  map.classes = {{"book", 0.05, 0.05, {}}};
  for (int i = 0; i < 300; ++i)
    map.objects.push_back({"book", 0, {3.9, 1.25 + 0.05 * (i % 30), 1.2 + 0.06 * (i / 30)}, 0.05, 0.05});
  const std::string error = tests::refusal_of([&] { map_graphs(map, {}, 1.5, 4.0, 4); });
  CHECK(error == "from (2, 2) 300 objects of the map \"shelf\" are seen, more than 255; make photo.farthest_m smaller");
}

TEST_CASE("without errors of the detector pseudoranges are the true ranges") {
  const Photos photos(photo_study("building", perfect + ols), {0, 100});
  for (const PhotoRecord& record : photos.scratch.photos) {
    CHECK(record.pseudorange_error_m < 1e-12);
    CHECK(record.image_distance_mm > 4.15);
  }
}

TEST_CASE("problems hold what the starts observed") {
  const Photos photos(photo_study("building", "[photo]\nscores = \"detector\"\n" + ols), {0, 50});
  const BuildingScratch& s = photos.scratch;
  const sim::BuildingMap& map = *photos.scene.settings.photo.map;
  std::size_t problems = 0;
  for (const StartGroup& group : s.groups) {
    problems += group.starts.size();
    for (std::size_t t = 0; t < group.starts.size(); ++t) {
      const StartRecord& start = s.starts[group.starts[t]];
      REQUIRE(start.points == group.points);
      CHECK(group.points >= 3);
      CHECK(group.problems.start(0)[t] == start.place_m[0]);
      CHECK(group.problems.start(2)[t] == 1.5);
      CHECK(group.problems.start_image_distance()[t] == 4.15);
      CHECK(group.truth[1][t] == s.photos[start.photo].truth_m[1]);
      CHECK(group.image_distance[t] == s.photos[start.photo].image_distance_mm);
      for (std::size_t j = 0; j < group.points; ++j) {
        const Observed& observed = s.observed[start.first + j];
        CHECK(group.problems.position(j, 2)[t] == map.objects[observed.object].centre_m[2]);
        CHECK(group.problems.alpha(j)[t] == observed.pseudorange.alpha);
        CHECK(group.problems.measured(j)[t] == observed.pseudorange.rho);
        CHECK(group.problems.score(j)[t] == observed.score);
      }
    }
  }
  CHECK(problems == s.starts.size());
}

TEST_CASE("starts all over the map take every detection for its own object") {
  const Photos photos(photo_study("building", "[coarse]\nstarts = \"grid\"\nstart_spacing_m = 4.0\n" + ols), {0, 5});
  const auto places = grid_places(*photos.scene.settings.photo.map, 4.0);
  REQUIRE(photos.scratch.starts.size() == 5 * places.size());
  for (std::size_t i = 0; i < photos.scratch.starts.size(); ++i) {
    CHECK(photos.scratch.starts[i].place_m == places[i % places.size()]);
    CHECK(photos.scratch.starts[i].points == photos.scratch.photos[i / places.size()].detections);
  }
  // Of the last photo the detections are there to compare with.
  const StartRecord& last = photos.scratch.starts.back();
  for (std::size_t j = 0; j < last.points; ++j) {
    CHECK(photos.scratch.observed[last.first + j].object == photos.scratch.photo.detections[j].object);
  }
}

TEST_CASE("from right starts and without errors least squares ends at the truth") {
  // The image distance is free, so that the residuals vanish at the truth, and the best coarse position is the start.
  const Study study = photo_study("building", perfect + R"([photo]
detections = 5
[coarse]
coarse_topk = 1
[solver]
step_tolerance_m = 1e-9
max_iterations = 100
)" + ols);
  Photos photos(study, {0, 200});
  photos.locate(study.methods[0]);
  std::size_t right = 0;
  std::size_t exact = 0;
  for (std::size_t p = 0; p < photos.scratch.photos.size(); ++p) {
    if (photos.scratch.photos[p].coarse_right != 1.0) continue;
    ++right;
    const PhotoOutcome& outcome = photos.scratch.outcomes[p];
    exact += outcome.status == PhotoStatus::Success && outcome.error_m < 1e-6 ? 1 : 0;
  }
  CHECK(right > 150);
  CHECK(exact > right * 9 / 10);  // the others may end at another minimum
}

TEST_CASE("with the image distance taken for the focal length photos are located to centimetres") {
  // v - f is f / u of f: ranges are short by f r / u, some 4 mm whatever the distance, which the geometry magnifies.
  const Study study = photo_study("building", perfect + R"([photo]
detections = 5
[coarse]
coarse_topk = 1
[solver]
v_mode = "fixed"
step_tolerance_m = 1e-9
)" + ols);
  Photos photos(study, {0, 200});
  photos.locate(study.methods[0]);
  std::vector<double> errors;
  for (std::size_t p = 0; p < photos.scratch.photos.size(); ++p) {
    const PhotoOutcome& outcome = photos.scratch.outcomes[p];
    if (photos.scratch.photos[p].coarse_right == 1.0 && outcome.status == PhotoStatus::Success) {
      errors.push_back(outcome.error_m);
    }
  }
  REQUIRE(errors.size() > 100);
  std::ranges::sort(errors);
  CHECK(errors[errors.size() / 2] < 0.01);
  CHECK(errors[errors.size() * 9 / 10] < 0.05);
}

TEST_CASE("least squares of photos ends at the minimisers of Ceres", "[reference]") {
  const Study study = photo_study("building", R"([solver]
step_tolerance_m = 1e-10
max_iterations = 10000
[[method]]
solver = "ols"
[[method]]
solver = "lm"
[[method]]
name = "ols, v fixed"
solver = "ols"
v_mode = "fixed"
[[method]]
name = "marquardt, v fixed"
solver = "lm"
lm_variant = "marquardt"
v_mode = "fixed"
)");
  Photos photos(study, {0, 100});
  for (const Method& method : study.methods) {
    const auto options = solver_options(photos.plan.cells[0].values, method.given);
    std::size_t converged = 0;
    std::size_t same_basin = 0;
    std::size_t at_rest = 0;
    std::size_t disagree = 0;
    double largest_m = 0.0;
    for (const StartGroup& group : photos.scratch.groups) {
      if (group.starts.empty()) continue;
      core::Oracle oracle;
      for (std::size_t axis = 0; axis < 3; ++axis) oracle.truth[axis] = group.truth[axis];
      oracle.image_distance = group.image_distance;
      core::SolutionBatch solutions;
      solvers::solver_named(method.solver).solve(group.problems, options, &oracle, solutions);
      std::vector<std::size_t> slots(group.starts.size());
      for (std::size_t t = 0; t < slots.size(); ++t) slots[t] = t;
      Audit audit(group.problems, oracle, slots);
      Audit::Columns columns;
      REQUIRE(audit.fill(method.solver, options, solutions, NoMonitor(), columns));
      for (const std::size_t t : slots) {
        if (static_cast<core::Status>(solutions.status[t]) != core::Status::Converged) continue;
        ++converged;
        disagree += columns[RefDisagrees][t] == 1.0 ? 1 : 0;
        if (columns[RefSameBasin][t] != 1.0) continue;
        ++same_basin;
        // Damping makes the steps of lm short where those of Gauss and Newton are not: there it stops on its way.
        if (solutions.remaining_step_m[t] > 10.0 * options.step_tolerance_m) continue;
        ++at_rest;
        largest_m = std::max(largest_m, columns[RefGapM][t]);
      }
    }
    std::printf("%s: %zu converged, %zu in the same basin, %zu of them at rest, largest gap %.3g m\n",
                method.label.c_str(), converged, same_basin, at_rest, largest_m);
    CAPTURE(method.label);
    CHECK(converged > 50);
    CHECK(same_basin > converged / 2);
    CHECK(at_rest > same_basin / 2);
    CHECK(largest_m <= 1e-6);  // Gauss and Newton's steps shrink by a constant factor, of 0.999 at worst
    CHECK(disagree == 0);
  }
}
