#include "studies/ranging/ranging.hpp"
#include "solvers/kernels/geometry.hpp"

#include <algorithm>
#include <cmath>

#include "core/status.hpp"
#include "results/blocks/block.hpp"
#include "results/statistics/interval.hpp"
#include "sim/field_of_view.hpp"
#include "sim/range_noise.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/plan/assignment.hpp"
#include "studies/plan/plan.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/metric_of.hpp"
#include "tests/support/simulation.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using tests::first_block;

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
  std::vector<double> condition(2);
  const std::vector<double> origin(2, 0.0);
  core::Oracle oracle;
  for (auto& axis : oracle.truth) axis = origin;
  solvers::geometry_of(p, {}, oracle, gdop, condition);
  CHECK(gdop[0] == Approx(std::sqrt(3.0)));  // J'J = I
  CHECK(condition[0] == Approx(1.0));
  CHECK(std::isinf(gdop[1]));
  CHECK(std::isinf(condition[1]));
}

TEST_CASE("numbers of the experiment change only with its version") {
  // Golden: the digests of one block, of each method and the scene, on the baseline and on the instruction sets with a
  // fused multiply-add, which agree. A deliberate change of the numbers raises Ranging::version and updates these; an
  // accidental one is caught here.
  struct Golden {
    const char* study;
    std::vector<std::uint64_t> baseline;
    std::vector<std::uint64_t> fused;
  };
  const Golden golden = GENERATE(
      Golden{R"(
experiment = "ranging"
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
)",
             {0x2c911d1daa1a706c, 0xc0c389f60665d6a7, 0xf32bd95d5231409b, 0x656239828c0fa239, 0x2158a5267b6b81ff,
              0xd2684ff90e725d90},
             {0x48ee286916d6062d, 0xe0edc3780474ce2, 0x91921fcbdda0158, 0xc0f18556d8b61b99, 0x9086f81390de8db,
              0xde744d16eab6c4f2}},
      Golden{R"(
experiment = "ranging"
seed = 7
[scene]
points = 3
azimuth_deg = [-30, 45]
elevation_deg = [-10, 20]
depth_m = [2, 30]
depth_distribution = "volume"
start_offset_m = 2.5
[noise]
range_sigma_m = 0.5
[solver]
max_iterations = 12
step_tolerance_m = 0.01
[[method]]
solver = "ols"
[[method]]
name = "positive, per trial"
solver = "rr"
k = "oracle_elem"
similarity = 0.7
k_error = "positive"
k_error_draw = "per_trial"
ktrue = "gm"
[[method]]
solver = "rrr"
theta_m = 0.2
eta = "absolute"
[[method]]
name = "fixed"
solver = "rrr"
k = "fixed"
k_fixed = 0.3
)",
             {0x1195eb4d9fb89682, 0x55ad42cf276f79e2, 0x577123504cde3b23, 0xded66517699ce948, 0x31e50b8206d963f6},
             {0x98782c313cd4982f, 0x554ab3af8df6208a, 0x7d1af0ced9acb56e, 0xb820767fec4c4032, 0x390323d34a16b9c5}},
      Golden{R"(
experiment = "ranging"
[noise]
noise_model = "student_t"
noise_dof = 2.5
scores = "random"
[[method]]
solver = "ols"
)",
             {0x1717eb2c98d45f40, 0xd2684ff90e725d90},
             {0xc41b13480a30a865, 0xde744d16eab6c4f2}},
      Golden{R"(
experiment = "ranging"
[noise]
noise_model = "contaminated"
outlier_rate = 0.2
outlier_size = 7
[[method]]
solver = "ols"
)",
             {0xcc618250bf7e34cf, 0xd2684ff90e725d90},
             {0x52cb9d28158db8d1, 0xde744d16eab6c4f2}},
      Golden{R"(
experiment = "ranging"
[noise]
noise_model = "proportional"
reference_depth_m = 3
scores = "random"
score_low = 0.5
score_error_exponent = 0.7
[[method]]
solver = "ols"
)",
             {0x61f2686b95630707, 0xd2684ff90e725d90},
             {0x8644285ef7a4dfd3, 0xde744d16eab6c4f2}},
      Golden{R"(
experiment = "ranging"
[noise]
noise_model = "empirical"
noise_samples = [-2.0, 0.25, 0.5, 1.0, 3.0]
[[method]]
solver = "ols"
)",
             {0x927c747acb3f9c59, 0xd2684ff90e725d90},
             {0x78a01723cd172378, 0xde744d16eab6c4f2}},
      Golden{R"(
experiment = "ranging"
[scene]
objects = "given"
objects_m = [[0, 0, 2.5], [8, 0, 2], [8, 6, 0.5], [0, 6, 1], [4, 3, 2.8]]
camera_x_m = [1, 7]
camera_z_m = [1, 1.8]
[noise]
noise_model = "proportional"
[[method]]
solver = "lm"
)",
             {0x772fd2d391b1bfe5, 0x19ce447719c227c0},
             {0xe0701463f7c46c3d, 0xbf8e9f04dc5cbf5c}},
      Golden{R"(
experiment = "ranging"
[scene]
objects = "given"
objects_m = [[0, 0], [8, 0], [8, 6], [0, 6]]
camera_m = [[1, 2], [6, 5], [4, 3]]
z_mode = "fixed"
[[method]]
solver = "rr"
[[method]]
solver = "irls"
)",
             {0x39c5e5ecbfa5f1f2, 0x2f56fb13db5a7cc9, 0xab3f7eb683bdfa45},
             {0x76161437f9ae9b10, 0x5ac6b60a238890cb, 0xc7ba2243dcdc27b4}});
  const Study study = read_study({"golden", "golden.toml", golden.study}, std::vector<std::string>{"trials=4096"});
  REQUIRE(study.experiment->version() == 5);
  for (const core::Isa isa : {core::Isa::Baseline, core::Isa::Avx2, core::Isa::Avx512}) {
    if (!core::is_supported(isa)) continue;
    const auto rows = first_block(study, isa);
    const auto& digests = isa == core::Isa::Baseline ? golden.baseline : golden.fused;
    REQUIRE(rows.size() == digests.size());
    for (std::size_t method = 0; method < rows.size(); ++method) {
      INFO(core::name_of(isa) << " row " << method << " is 0x" << std::hex << rows[method].digests[0]);
      CHECK(rows[method].digests[0] == digests[method]);
    }
  }
}

TEST_CASE("columns hold what their descriptions say, for each way a trial can end") {
  // Too few iterations for some, and geometry bad enough for the others.
  const Study study = read_study({"ends", "ends.toml", R"(
experiment = "ranging"
trials = 4096
[scene]
points = 3
azimuth_deg = [-0.05, 0.05]
elevation_deg = [-0.05, 0.05]
[solver]
max_iterations = 5
[[method]]
solver = "ols"
)"});
  const auto rows = first_block(study);
  const results::Statistics& ols = rows[0].statistics;
  const std::uint64_t converged = ols.events[0];
  for (const auto status :
       {core::Status::Converged, core::Status::IterationLimit, core::Status::Singular, core::Status::LeftDomain}) {
    CHECK(ols.events[static_cast<std::size_t>(status)] > 0);
  }
  const auto of_solver = [&](const char* name) { return ols.metrics[tests::metric_of(study, name)]; };
  const auto every_value = [](const results::MetricStatistics& metric) { return metric.moments.n + metric.beyond; };
  CHECK(every_value(of_solver("error_m")) == converged);
  CHECK(every_value(of_solver("error_all_m")) == 4096);
  CHECK(of_solver("iterations").moments.n == 4096);
  CHECK(of_solver("iterations").max == 5.0);  // a failed trial counts the limit
  CHECK(of_solver("iterations").histogram.bins().back().count >= 4096 - converged);
  CHECK(of_solver("eta_first").moments.n == 0);  // ols has no K
  CHECK(of_solver("residual_rms_m").moments.n == converged);
  CHECK(every_value(rows[1].statistics.metrics[tests::metric_of(study, "gdop")]) == 4096);
  CHECK(rows[1].statistics.events.empty());
}

TEST_CASE(
    "least squares is as consistent as it claims where the problem is nearly linear, and says nothing elsewhere") {
  const auto nees = [](const std::string& noise, const std::string& method) {
    const Study study = read_study(
        {"nees", "nees.toml",
         "experiment = \"ranging\"\naudit = 0\n[scene]\npoints = 50\n[solver]\nstep_tolerance_m = 1e-6\n[noise]\n" +
             noise + "[[method]]\nsolver = " + method},
        std::vector<std::string>{"trials=4096"});
    const auto rows = first_block(study);
    return rows[0].statistics.metrics[tests::metric_of(study, "nees")].moments;
  };
  const std::string small = "range_sigma_m = 0.001\n";
  for (const char* solver : {"\"ols\"", "\"lm\"\nlm_variant = \"more\"", "\"dogleg\""}) {
    const results::Moments moments = nees(small, solver);
    const results::Interval range = results::chi_square_mean_range(moments.n, 3);
    CAPTURE(solver, moments.n, moments.mean);
    CHECK(moments.n > 4000);
    // Five standard errors, where 95 % lie within two.
    CHECK(std::abs(moments.mean - 3.0) < 2.5 * 0.5 * (range.hi - range.lo));
  }
  CHECK(nees(small, "\"rr\"").n == 0);
  CHECK(nees(small, "\"ols\"\njacobian = \"printed\"").n == 0);
  CHECK(nees(small + "noise_model = \"student_t\"\n", "\"ols\"").n == 0);
  CHECK(nees(small + "scores = \"random\"\n", "\"ols\"").n == 0);
  CHECK(nees("range_sigma_m = 0\n", "\"ols\"").n == 0);
}

TEST_CASE("solvers that are not held back are stationary where they converge") {
  const Study study = read_study({"stationary", "stationary.toml", R"(
experiment = "ranging"
trials = 4096
[scene]
points = 7
[noise]
range_sigma_m = 0.5
[[method]]
solver = "ols"
[[method]]
solver = "rrr"
)"});
  const auto rows = first_block(study);
  const auto share = [&](std::size_t method) {
    const auto& events = rows[method].statistics.events;
    return static_cast<double>(events[5]) / static_cast<double>(events[0]);
  };
  // Gauss-Newton converges linearly, with a factor below 1 nearly always: then the next step is shorter than the last.
  CHECK(share(0) > 0.99);
  // The ridge stops short of the minimiser (docs/methods.md).
  CHECK(share(1) < 0.9);
}

TEST_CASE("the anchor of Fig. 3b-d lies where an independent prototype found it") {
  // 5 points, sigma 0.1 m, similarity 0.6, W = I: 14.2 iterations, 80 % converged, median error 0.121 m, from 6000
  // trials of a prototype. Standard errors there: 0.13, 0.52 points, 0.002 m; ours are as large. |z| > 4.5 for the
  // difference has a false-alarm rate of 7e-6 each.
  const Study study = read_study(find_study("fig3bcd"),
                                 std::vector<std::string>{"sweep.points=[5]", "sweep.similarity=[0.6]", "trials=4096"});
  const results::Row rr = first_block(study)[0];
  const auto& iterations = rr.statistics.metrics[tests::metric_of(study, "iterations")].moments;
  const double iterations_error = std::sqrt(iterations.m2 / 4096.0 / 4096.0 + iterations.m2 / 4096.0 / 6000.0);
  CHECK(std::fabs(iterations.mean - 14.2) < 4.5 * iterations_error + 0.05);  // the prototype's is rounded
  const double converged = static_cast<double>(rr.statistics.events[0]) / 4096.0;
  CHECK(std::fabs(converged - 0.80) < 4.5 * std::sqrt(0.16 / 4096.0 + 0.16 / 6000.0) + 0.005);
  const auto& errors = rr.statistics.metrics[tests::metric_of(study, "error_m")];
  CHECK(std::fabs(errors.histogram.quantile(0.5) - 0.121) < 4.5 * 0.002 * std::sqrt(2.0) + 0.0005);
}
