// Scenes of given objects, and ranges with a known height.

#include "studies/ranging/given_objects.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "results/blocks/block.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/files/study_writer.hpp"
#include "studies/plan/assignment.hpp"
#include "studies/plan/plan.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/metric_of.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/simulation.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using tests::first_block;

namespace {

const std::string room = "objects_m = [[0, 0, 2.5], [8, 0, 2.0], [8, 6, 0.5], [0, 6, 1.0], [4, 3, 2.8]]\n";

std::string study_text(const std::string& scene, const std::string& rest = "") {
  return "experiment = \"ranging\"\ntrials = 4096\naudit = 0\n[scene]\nobjects = \"given\"\n" + scene + rest +
         "[[method]]\nsolver = \"lm\"\n[[method]]\nsolver = \"rrr\"\n";
}

Study read(const std::string& text, const std::string& path = "given.toml") {
  return read_study({"given", path, text});
}

std::string error_of(const std::string& scene, const std::string& rest = "") {
  return tests::refusal_of([&] { make_plan(read(study_text(scene, rest))); });
}

std::vector<std::string> remarks_of(const std::string& scene) {
  return make_plan(read(study_text(scene))).remarks;
}

double mean_of(const Study& study, const results::Row& row, const std::string& metric) {
  return row.statistics.metrics[tests::metric_of(study, metric)].moments.mean;
}

}  // namespace

TEST_CASE("objects come from the study or from a file beside it, and stay in the resolved study") {
  const tests::ScratchFolder folder;
  std::ofstream(folder / "anchors.csv") << "id;x_m;y_m;z_m\na;0;0;2,5\nb;8;0;2\nc;8;6;0,5\nd;0;6;1\ne;4;3;2,8\n";
  std::ofstream(folder / "plan.csv") << "north,east\n1,2\n3,4\n5,7\n";
  const std::string path = (folder / "s.toml").string();
  const Study listed = read(study_text(room));
  const Study filed = read(study_text("objects_m = { file = \"anchors.csv\" }\n"), path);
  CHECK(resolved_toml(filed) == resolved_toml(listed));
  CHECK(resolved_toml(read(resolved_toml(filed))) == resolved_toml(filed));
  CHECK(make_plan(filed).header.study_hash == make_plan(listed).header.study_hash);
  CHECK(resolved_toml(filed).find("objects_m = [[0.0, 0.0, 2.5], [8.0, 0.0, 2.0], ") != std::string::npos);

  const Study flat = read(study_text("objects_m = { file = \"plan.csv\", columns = [\"east\", \"north\"] }\n"), path);
  CHECK(std::get<Positions>(flat.fixed.at("objects_m")) == Positions({{2, 1, 0}, {4, 3, 0}, {7, 5, 0}}));
  CHECK(read(study_text("objects_m = [[2, 1], [4, 3], [7, 5]]\n")).fixed == flat.fixed);
}

TEST_CASE("a scene of given objects that cannot be is refused in one line") {
  const std::string far = "objects_m = [[0, 0, 0], [1, 0, 0], [0, 5e6, 0]]\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {error_of(""), "scene.objects = \"given\" needs scene.objects_m: a list of positions"},
      {error_of("objects_m = []\n"), "needs scene.objects_m"},
      {error_of("objects_m = 3\n"), "given.toml:6: scene.objects_m = 3 is not allowed: scene.objects_m takes a list"},
      {error_of("objects_m = [1, 2, 3]\n"), "given.toml:6: scene.objects_m[0] = 1 is no position: give [x, y, z]"},
      {error_of("objects_m = [[1, 2, 3], [1]]\n"), "scene.objects_m[1] = [ 1 ] is no position"},
      {error_of("objects_m = [[1, 2, \"a\"]]\n"), "given.toml:6: scene.objects_m[0][2] = 'a' is not a number"},
      {error_of("objects_m = [[0, 0], [1, nan], [1, 1]]\n"), "scene.objects_m: nan is not allowed: coordinates"},
      {error_of(far), "scene.objects_m: 5000000 is not allowed: coordinates are numbers from -100000 to 100000 m; sub"},
      {error_of("objects_m = [[0, 0], [1, 0]]\n"),
       "given: scene.objects_m: 2 objects are measured; 3 to 1000 are allowed (2 with a known height"},
      {error_of("z_mode = \"fixed\"\nobjects_m = [[0, 0]]\n"), "1 objects are measured; 2 to 1000 are allowed"},
      {error_of(room + "objects_used = 6\n"), "scene.objects_used = 6, but scene.objects_m has 5 objects"},
      {error_of(room + "objects_used = 2\n"), "2 objects are measured; 3 to 1000"},
      {error_of("objects_m = [[0, 0], [1, 0], [0, 1], [1, 0]]\n"), "objects 2 and 4 are both at [1, 0, 0]; leave one"},
      {error_of(room + "camera_x_m = [4, 4]\ncamera_y_m = [3, 3]\ncamera_z_m = [2.8, 2.8]\n"),
       "the camera at [4, 3, 2.8] stands on object 5"},
      {error_of(room + "camera_m = [[1, 1, 1], [8, 6, 0.5]]\n"), "the camera at [8, 6, 0.5] stands on object 3"},
      {error_of(room + "camera_m = [[1, 1, 1]]\ncamera_z_m = [0, 1]\n"),
       "scene.camera_m gives the positions of the cam"},
      {error_of(room + "model = \"pseudorange\"\n"), "scene.objects = \"given\" goes with scene.model = \"range\""},
      {error_of("objects_m = { file = \"none.csv\" }\n"), "scene.objects_m.file: there is no file none.csv"},
      {error_of("objects_m = { columns = [\"a\", \"b\"] }\n"), "scene.objects_m lacks file"},
      {error_of("objects_m = { file = \"none.csv\", columns = \"x\" }\n"), "scene.objects_m.columns names 1: give two"},
      {error_of(room, "[sweep]\npoints = [3, 4]\n"),
       "sweep.points changes nothing: it is read only if objects is drawn"},
      {error_of(room, "[sweep]\nobjects_m = [[[0, 0]]]\n"), "objects_m cannot be swept; make one study of each"},
  };
  for (const auto& [error, message] : cases) {
    INFO(message << "\n-> " << error);
    CHECK(error.find(message) != std::string::npos);
    CHECK(error.find('\n') == std::string::npos);
  }
  CHECK(error_of(room + "camera_x_m = [0, 8]\n",
                 "[sweep]\nobjects_used = [3, 0]\nz_mode = [\"free\", \"fixed\"]\n"
                 "camera_z_m = [[0, 0], [1, 1]]\n") == "");
  CHECK(error_of("z_mode = \"fixed\"\nobjects_m = [[1, 0], [5, 1]]\n") == "");
}

TEST_CASE("objects that leave a position open wherever the camera is are remarked on, and not refused") {
  CHECK(remarks_of(room).empty());
  CHECK(remarks_of(room + "z_mode = \"fixed\"\n").empty());
  const auto plane = remarks_of("objects_m = [[1, 0, 2], [8, 0, 2], [8, 6, 2], [0, 6, 2]]\n");
  REQUIRE(plane.size() == 1);
  CHECK(plane[0].starts_with("all objects lie in one plane: every position has a mirror image"));
  // A plane that no axis is normal to, in numbers that rounding moves out of it.
  const std::string tilted = "objects_m = [[0.1, 0.2, 0.3], [8.1, 0.2, 2.7], [8.1, 6.2, 1.5], [0.1, 6.2, -0.9]]\n";
  CHECK(remarks_of(tilted).size() == 1);
  CHECK(remarks_of(tilted + "z_mode = \"fixed\"\n").empty());
  CHECK(
      remarks_of("objects_m = [[1, 0, 2], [2, 0, 3], [4, 0, 5]]\n")[0].starts_with("all objects lie on one line: ran"));
  CHECK(remarks_of("z_mode = \"fixed\"\nobjects_m = [[1, 0, 2], [2, 0, 9], [4, 0, 5]]\n")[0].starts_with(
      "all objects lie on one line, seen from above: every position has a mirror image"));
  CHECK(remarks_of("objects_used = 3\n" + room).size() == 1);  // three objects always lie in one plane
  CHECK(make_plan(read_study({"s", "s.toml", "experiment = \"ranging\"\n[[method]]\nsolver = \"lm\"\n"}))
            .remarks.empty());
}

TEST_CASE("errors are those of the true position, wherever the camera is") {
  for (const std::string camera :
       {"camera_m = [[1, 1, 1], [6, 2, 0.3]]\n", "camera_x_m = [1, 7]\ncamera_y_m = [1, 5]\n"}) {
    const Study study = read(study_text(room + camera,
                                        "[noise]\nrange_sigma_m = 0.001\n[solver]\nstep_tolerance_m = 1e-6\n"
                                        "start = \"bancroft\"\n"));
    for (const core::Isa isa : {core::Isa::Baseline, core::Isa::Avx2, core::Isa::Avx512}) {
      if (!core::is_supported(isa)) continue;
      const auto rows = first_block(study, isa);
      INFO(camera << core::name_of(isa));
      const results::Statistics& lm = rows[0].statistics;
      CHECK(lm.events[0] > 4000);
      const results::Moments& error = lm.metrics[tests::metric_of(study, "error_x_m")].moments;
      CHECK(std::fabs(error.mean) < 0.001);
      CHECK(mean_of(study, rows[0], "error_m") < 0.01);
      CHECK(mean_of(study, rows[0], "error_m") > 0.0005);
    }
  }
}

TEST_CASE("with a known height two ranges have a bound of their own, and errors lie in the plane") {
  // Objects in two directions at right angles: J is the identity, the dilution sqrt 2.
  const Study study =
      read(study_text("z_mode = \"fixed\"\nobjects_m = [[5, 0, 1.5], [0, 4, 1.5]]\ncamera_z_m = [1.5, 1.5]\n"
                      "start_offset_m = 0.5\n",
                      "[noise]\nrange_sigma_m = 0.01\n[solver]\nstep_tolerance_m = 1e-9\n"));
  const auto rows = first_block(study);
  CHECK(rows[0].statistics.events[0] == 4096);
  CHECK(mean_of(study, rows[2], "gdop") == Approx(std::sqrt(2.0)));
  CHECK(mean_of(study, rows[2], "condition") == Approx(1.0));
  CHECK(mean_of(study, rows[2], "crb_m") == Approx(0.01 * std::sqrt(2.0)));
  // Nearly linear: the mean square error is that of the bound, 2 sigma^2, its standard error 2 sigma^2 / sqrt(n);
  // within five of them, and a hundredth for what is not linear.
  const double expected = 2.0 * 0.01 * 0.01;
  CHECK(std::fabs(mean_of(study, rows[0], "squared_error_m2") / expected - 1.0) < 5.0 / 64.0 + 0.01);
  CHECK(rows[0].statistics.metrics[tests::metric_of(study, "nees")].moments.n == 0);
}

TEST_CASE("Ceres agrees where the height is known") {
  const Study study = read(study_text(room + "z_mode = \"fixed\"\ncamera_x_m = [1, 7]\ncamera_y_m = [1, 5]\n"));
  const auto rows = first_block(study, core::Isa::Baseline, 0.001);
  for (const std::size_t method : {0U, 1U}) {
    const auto& metrics = rows[method].statistics.metrics;
    CHECK(metrics[tests::metric_of(study, "ref_converged")].moments.n >= 100);
    CHECK(metrics[tests::metric_of(study, "ref_disagrees")].moments.mean == 0.0);
    CHECK(metrics[tests::metric_of(study, "ref_same_basin")].moments.mean > 0.9);
  }
}

TEST_CASE("bounds of scenes of given objects are good for what they are good for") {
  const auto kind = [](const std::string& scene) { return make_plan(read(study_text(scene))).header.cells[0].bound; };
  CHECK(kind(room) == results::BoundKind::RootMeanSquare);
  CHECK(kind(room + "camera_m = [[1, 1, 1], [2, 2, 2]]\n") == results::BoundKind::RootMeanSquare);
  CHECK(kind(room + "camera_x_m = [0, 8]\n") == results::BoundKind::Quantiles);
}
