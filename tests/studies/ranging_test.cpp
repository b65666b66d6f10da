#include "studies/ranging.hpp"

#include <cmath>

#include "catch.hpp"
#include "results/block.hpp"
#include "sim/field_of_view.hpp"
#include "sim/range_noise.hpp"
#include "studies/plan.hpp"
#include "studies/study_reader.hpp"
#include "studies/yardsticks.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

TEST_CASE("the dilution of precision is that of the geometry") {
  core::ProblemBatch p;
  p.reshape(3, 2);
  const double coordinates[3][3] = {{2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      p.position(j, axis)[0] = coordinates[j][axis];
      p.position(j, axis)[1] = coordinates[0][axis];  // the second trial sees one point three times
    }
  }
  std::vector<double> gdop(2);
  dilution_of_precision(p, {0, 0, 0}, gdop);
  CHECK(gdop[0] == Approx(std::sqrt(3.0)));  // J'J = I
  CHECK(std::isinf(gdop[1]));
}

TEST_CASE("numbers of the experiment change only with its version") {
  // Golden: the digest of one block of each method. A deliberate change of the numbers raises Ranging::version and
  // updates these; an accidental one is caught here.
  const Study study = read_study({"golden", "golden.toml", R"(
experiment = "ranging"
trials = 4096
[[method]]
solver = "ols"
[[method]]
solver = "lm"
[[method]]
solver = "rr"
[[method]]
solver = "rrr"
[[method]]
name = "oracle"
solver = "rrr"
k = "oracle_gm"
similarity = 0.8
)"});
  const Plan plan = make_plan(study);
  results::BlockSink sink(plan.header, 0, 0, 4096);
  const auto workspace = study.experiment->make_workspace();
  study.experiment->run_block(study.seed, plan.cells[0], study.methods, plan.range(0), *workspace, sink);
  REQUIRE(study.experiment->version() == 1);
  const std::uint64_t golden[] = {0xdbb973103d6b0f87, 0x0d84c669aeed0b3b, 0xfaabd91a6d208534,
                                  0x58672b143de95307, 0x3d237694a69e51ca, 0xa5aee750bf5e4a72};
  const auto rows = sink.take_rows();
  REQUIRE(rows.size() == 6);
  for (std::size_t method = 0; method < 6; ++method) {
    INFO(plan.header.methods[method].label);
    REQUIRE(rows[method].digests.size() == 1);
    CHECK(rows[method].digests[0] == golden[method]);
  }
}

TEST_CASE("the anchor of Fig. 3b-d lies where an independent prototype found it") {
  // 5 points, sigma 0.1 m, similarity 0.6, W = I: 14.2 iterations, 80 % converged, median error 0.121 m, from 6000
  // trials of a prototype. Standard errors there: 0.13, 0.52 points, 0.002 m; ours are as large. |z| > 4.5 for the
  // difference has a false-alarm rate of 7e-6 each.
  const Study study = read_study(find_study("fig3bcd"), std::vector<std::string>{"sweep.points=[5]", "sweep.similarity=[0.6]",
                                                                               "trials=4096"});
  const Plan plan = make_plan(study);
  results::BlockSink sink(plan.header, 0, 0, 4096);
  const auto workspace = study.experiment->make_workspace();
  study.experiment->run_block(study.seed, plan.cells[0], study.methods, plan.range(0), *workspace, sink);
  const results::Row rr = sink.take_rows()[0];
  const auto& iterations = rr.statistics.metrics[2].moments;
  const double iterations_error = std::sqrt(iterations.m2 / 4096.0 / 4096.0 + iterations.m2 / 4096.0 / 6000.0);
  CHECK(std::fabs(iterations.mean - 14.2) < 4.5 * iterations_error + 0.05);  // the prototype's is rounded
  const double converged = static_cast<double>(rr.statistics.events[1]) / 4096.0;
  CHECK(std::fabs(converged - 0.80) < 4.5 * std::sqrt(0.16 / 4096.0 + 0.16 / 6000.0) + 0.005);
  CHECK(std::fabs(rr.statistics.metrics[0].histogram.quantile(0.5) - 0.121) < 4.5 * 0.002 * std::sqrt(2.0) + 0.0005);
}
