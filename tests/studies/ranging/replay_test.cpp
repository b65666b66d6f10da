#include "studies/study/replay.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/isa.hpp"
#include "core/status.hpp"
#include "results/blocks/block.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/plan/plan.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/metric_of.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/simulation.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using results::DataTable;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

const char* methods = R"(
[[method]]
solver = "ols"
[[method]]
solver = "lm"
[[method]]
solver = "rr"
[[method]]
solver = "rrr"
[[method]]
solver = "irls"
[[method]]
solver = "bancroft"
[[method]]
name = "oracle"
solver = "rrr"
k = "oracle_elem"
similarity = 0.7
)";

Study study(const std::string& scene) {
  return read_study({"replay", "replay.toml", "experiment = \"ranging\"\ntrials = 8192\n" + scene + methods});
}

Replay replay(const Study& s, std::uint64_t trial, core::Isa isa = core::best_isa()) {
  const Plan plan = make_plan(s, isa);
  return tests::PreparedCell(s, plan.cells[0], isa).replay(trial);
}

/// What a whole block reports of its trials, by method.
std::vector<results::TrialColumns> block(const Study& s, std::uint64_t number, core::Isa isa) {
  const Plan plan = make_plan(s, isa);
  const TrialRange range{number * plan.header.block_trials, plan.header.block_trials};
  results::BlockSink sink(plan.header, 0, number, range.count);
  tests::PreparedCell(s, plan.cells[0], isa).run(range, sink);
  return sink.take_columns();
}

const DataTable& table(const std::vector<DataTable>& tables, const std::string& name) {
  const auto found = std::ranges::find(tables, name, &DataTable::name);
  REQUIRE(found != tables.end());
  return *found;
}

/// A number of a table; NaN where there is none.
double number(const DataTable& t, std::size_t row, const std::string& column) {
  const auto found = std::ranges::find(t.columns, column);
  REQUIRE(found != t.columns.end());
  const results::Field& field = t.rows.at(row).at(static_cast<std::size_t>(found - t.columns.begin()));
  if (const auto* whole = std::get_if<std::int64_t>(&field)) return static_cast<double>(*whole);
  const auto* real = std::get_if<double>(&field);
  return real != nullptr ? *real : std::numeric_limits<double>::quiet_NaN();
}

std::string text(const DataTable& t, std::size_t row, std::size_t column) {
  return std::get<std::string>(t.rows.at(row).at(column));
}

}  // namespace

TEST_CASE("the kernels of a replay give the bits of the whole block, on every instruction set") {
  const std::string scene = GENERATE(
      std::string("[scene]\npoints = 3\n[noise]\nrange_sigma_m = 0.5\n"),
      std::string("[noise]\nrange_sigma_m = 0.3\nscores = \"random\"\n"),
      std::string("[scene]\nobjects = \"given\"\nobjects_m = [[0, 0, 2.5], [8, 0, 2], [8, 6, 0.5], [0, 6, 1]]\n"
                  "camera_x_m = [1, 7]\ncamera_z_m = [1, 2]\nz_mode = \"fixed\"\n"),
      std::string("[scene]\nmodel = \"pseudorange\"\ncamera = \"iphone6\"\nz_mode = \"fixed\"\npoints = 6\n"));
  const Study s = study(scene);
  for (const core::Isa isa : {core::Isa::Baseline, core::Isa::Avx2, core::Isa::Avx512}) {
    if (!core::is_supported(isa)) continue;
    for (const std::uint64_t number_of_block : {0, 1}) {
      const auto columns = block(s, number_of_block, isa);
      for (const std::size_t slot : {7U, 9U, 4095U}) {
        const Replay r = replay(s, number_of_block * 4096 + slot, isa);
        for (std::size_t m = 0; m < s.methods.size(); ++m) {
          CAPTURE(scene, core::name_of(isa), number_of_block, slot, s.methods[m].label);
          const DataTable& outcome = table(r.methods[m].tables, "outcome");
          CHECK(text(outcome, 1, 0) == core::name_of(isa));
          const auto status = columns[m].status[slot];
          const bool converged = status == static_cast<std::uint8_t>(core::Status::Converged);
          CHECK(text(outcome, 1, 1) == core::status_names[status]);
          const auto in_block = [&](const char* name) { return columns[m].metrics[tests::metric_of(s, name)][slot]; };
          const double true_x = number(table(r.scene, "camera"), 0, "x_m");
          CHECK(tests::same_bits_or_nan(number(outcome, 1, "x_m") - true_x, in_block("error_x_m")));
          // Two ways to the root of three squares, each within 4 eps of it.
          CHECK(number(outcome, 1, "error_m") == Approx(in_block("error_all_m")).epsilon(8.0 * epsilon));
          if (converged) {
            CHECK(tests::same_bits_or_nan(number(outcome, 1, "residual_rms_m"), in_block("residual_rms_m")));
            CHECK(number(outcome, 1, "iterations") == in_block("iterations"));
          }
          if (!columns[m].metrics[tests::metric_of(s, "eta_mean")].empty()) {
            CHECK(tests::same_bits_or_nan(number(outcome, 1, "eta_mean"), in_block("eta_mean")));
          }
        }
      }
    }
  }
}

TEST_CASE("a replay tells the iterations of the double path, which the baseline shares") {
  const Study s = study("[noise]\nrange_sigma_m = 0.3\n");
  const Replay r = replay(s, 17, core::Isa::Baseline);
  REQUIRE(r.methods.size() == s.methods.size());
  for (const ReplayedMethod& method : r.methods) {
    INFO(method.label);
    const DataTable& outcome = table(method.tables, "outcome");
    const DataTable& iterations = table(method.tables, "iterations");
    CHECK(number(outcome, 1, "difference_m") == 0.0);
    CHECK(static_cast<double>(iterations.rows.size() - 1) == number(outcome, 0, "iterations"));
    for (const char* axis : {"x_m", "y_m", "z_m"}) {
      CHECK(number(iterations, iterations.rows.size() - 1, axis) == number(outcome, 0, axis));
      if (method.solver != "bancroft") CHECK(number(iterations, 0, axis) == number(table(r.scene, "camera"), 1, axis));
    }
    const bool has_k = method.solver == "rr" || method.label == "rrr";
    if (has_k) CHECK(number(iterations, 0, "k") > 0.0);
  }
  CHECK(table(r.scene, "objects").rows.size() == 5);
  const DataTable& objects = table(r.scene, "objects");
  for (std::size_t j = 0; j < 5; ++j) {  // five standard deviations
    CHECK(std::fabs(number(objects, j, "measured_range_m") - number(objects, j, "true_range_m")) < 1.5);
  }
}

TEST_CASE("a replay asks Ceres where a method has an objective") {
  const Study s = study("[noise]\nrange_sigma_m = 0.05\n[solver]\nstep_tolerance_m = 1e-9\nmax_iterations = 1000\n");
  const Replay r = replay(s, 3);
  for (const ReplayedMethod& method : r.methods) {
    INFO(method.label);
    const DataTable& ceres = table(method.tables, "ceres");
    if (method.solver == "bancroft") {
      CHECK(ceres.rows.empty());
      continue;
    }
    REQUIRE(ceres.rows.size() == 2);
    // rr and rrr creep: their last step may be a small part of the way that is left. Other minima are metres away.
    CHECK(number(ceres, 0, "from_estimate_m") < 0.01);
  }
}

TEST_CASE("the drawing of a replay shows the scene, every path and contours") {
  const Study s = study("[scene]\npoints = 3\n[noise]\nrange_sigma_m = 0.5\n");
  const Replay r = replay(s, 7);  // on which ols diverges
  const auto& d = std::get<results::Drawing>(r.drawing);
  REQUIRE(d.paths.size() == s.methods.size());
  CHECK(d.paths[0].label == "ols");
  CHECK_FALSE(d.paths[0].filled_end);
  CHECK_FALSE(d.window.contains(d.paths[0].points.back()));
  CHECK(d.paths[2].filled_end);
  CHECK(d.paths[2].points.size() == table(r.methods[2].tables, "iterations").rows.size());
  CHECK(d.places[0].points.size() == 3);
  CHECK(d.places[0].texts == std::vector<std::string>{"1", "2", "3"});
  for (const results::DrawnPoint& object : d.places[0].points) CHECK(d.window.contains(object));
  CHECK(d.window.contains({0.0, 0.0}));
  REQUIRE(d.contours);
  CHECK(d.contours->levels.size() >= 3);
  // The least value of least squares is that of Ceres: none of the plane is smaller by more than the rounding of ranges
  // of 20 m at most, which 1e-12 m bounds.
  const DataTable& ceres = table(r.methods[0].tables, "ceres");
  const double least = std::sqrt(2.0 * number(ceres, 0, "objective") / 3.0);
  for (const auto& row : d.contours->values) {
    for (const double value : row) CHECK(value >= least - 1e-12);
  }
}
