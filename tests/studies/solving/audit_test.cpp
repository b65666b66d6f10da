#include "studies/solving/audit.hpp"
#include "studies/study/audit_sample.hpp"

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/isa.hpp"
#include "core/status.hpp"
#include "results/blocks/block.hpp"
#include "sim/kernels.hpp"
#include "solvers/solver.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/plan/plan.hpp"
#include "studies/registry.hpp"
#include "studies/study/capabilities.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/metric_of.hpp"
#include "tests/support/simulation.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

Study study(const std::vector<std::string>& overrides) {
  return read_study({"audit", "audit.toml", R"(
experiment = "ranging"
trials = 4096
[[method]]
solver = "ols"
[[method]]
solver = "rr"
[[method]]
solver = "rrr"
[[method]]
solver = "linear"
)"},
                    overrides);
}

std::vector<results::Row> block(const Study& s, core::Isa isa, TrialRange range) {
  const Plan plan = make_plan(s, isa);
  results::BlockSink sink(plan.header, 0, 0, range.count);
  tests::PreparedCell(s, plan.cells[0], isa, s.audit).run(range, sink);
  return sink.take_rows();
}

std::size_t index_of(const std::string& metric) {
  return tests::metric_of(study({}), metric);
}

/// Ranges of the experiment's default cell with what ols and Ceres make of them.
struct Solved {
  core::ProblemBatch problems;
  std::array<std::vector<double>, 3> truth;
  core::SolutionBatch solutions;
  solvers::SolverOptions options;

  Solved() {
    constexpr std::size_t trials = 50;
    problems.reshape(5, trials);
    const sim::FieldOfView view;
    const sim::Kernels scene = sim::kernels(core::Isa::Baseline);
    scene.place_objects(view, sim::SceneStreams(1, view), 0, problems);
    scene.measure_ranges(sim::noise_registry()[0], {.range_sigma_m = 0.1}, core::Stream(1, "noise"), 0, problems);
    for (auto& axis : truth) axis.assign(trials, 0.0);
    options.step_tolerance_m = 1e-9;
    options.max_iterations = 1000;
    solvers::solver_named("ols").solve(problems, options, nullptr, solutions);
  }

  Audit::Columns columns(std::vector<std::size_t> slots) const {
    core::Oracle oracle;
    for (std::size_t axis = 0; axis < 3; ++axis) oracle.truth[axis] = truth[axis];
    Audit audit(problems, oracle, std::move(slots));
    Audit::Columns result;
    REQUIRE(audit.fill("ols", options, solutions, NoMonitor(), result));
    return result;
  }
  std::size_t converged() const {
    return static_cast<std::size_t>(std::ranges::find(solutions.status, 0) - solutions.status.begin());
  }
};

}  // namespace

TEST_CASE("which trials are audited depends on seed and trial alone") {
  const AuditSample sample({7, 0.01});
  const auto all = sample.slots({0, 100'000});
  for (std::size_t t = 0; t < always_audited; ++t) CHECK(all[t] == t);
  // A tenth of a standard deviation is 3.2 trials of 999; false alarm below 1e-6.
  CHECK(std::fabs(static_cast<double>(all.size()) - 100.0 - 999.0) < 5.0 * std::sqrt(999.0));
  // However the trials are cut.
  std::vector<std::size_t> pieces;
  for (std::size_t first = 0; first < 100'000; first += 4093) {
    for (const std::size_t slot : sample.slots({first, std::min<std::size_t>(4093, 100'000 - first)})) {
      pieces.push_back(first + slot);
    }
  }
  CHECK(pieces == all);
  // A larger share audits those and more; another seed others.
  const auto more = AuditSample({7, 0.02}).slots({0, 100'000});
  CHECK(std::ranges::includes(more, all));
  CHECK(AuditSample({8, 0.01}).slots({0, 100'000}) != all);
  CHECK(AuditSample({7, 0.0}).slots({0, 100'000}).empty());
  CHECK(AuditSample({7, 1.0}).slots({5000, 300}).size() == 300);
}

TEST_CASE("an audit adds metrics and changes nothing else, on any instruction set") {
  const Study with = study({"audit=0.02"});
  const Study without = study({"audit=0"});
  const auto audited = AuditSample({with.seed, with.audit}).slots({0, 4096}).size();
  const std::size_t first = index_of("ref_gap_m");
  std::vector<results::Row> fused;
  for (const core::Isa isa : {core::Isa::Baseline, core::Isa::Avx2, core::Isa::Avx512}) {
    if (!core::is_supported(isa)) continue;
    const auto rows = block(with, isa, {0, 4096});
    const auto plain = block(without, isa, {0, 4096});
    CHECK(block(with, isa, {0, 4096})[2].digests == rows[2].digests);
    for (std::size_t method = 0; method < 3; ++method) {
      CAPTURE(core::name_of(isa), method);
      const auto& metrics = rows[method].statistics.metrics;
      CHECK(rows[method].statistics.events == plain[method].statistics.events);
      for (std::size_t m = 0; m < first; ++m) CHECK(metrics[m] == plain[method].statistics.metrics[m]);
      const std::size_t end = first + audit_metrics_of(*with.experiment);
      for (std::size_t m = first; m < end; ++m) CHECK(plain[method].statistics.metrics[m].moments.n == 0);
      for (std::size_t m = end; m < metrics.size(); ++m) CHECK(metrics[m] == plain[method].statistics.metrics[m]);
      CHECK(metrics[index_of("ref_converged")].moments.n == audited);
      CHECK(metrics[index_of("ref_gap_m")].moments.n > audited * 9 / 10);
      CHECK(metrics[index_of("ref_disagrees")].moments.n > audited * 9 / 10);
      CHECK(metrics[index_of("ref_disagrees")].moments.mean == 0.0);
      CHECK(metrics[index_of("ref_same_basin")].moments.mean > 0.9);
      CHECK(metrics[index_of("ref_truth_basin")].moments.mean > 0.8);
      if (isa != core::Isa::Baseline && !fused.empty()) CHECK(rows[method].digests == fused[method].digests);
    }
    // linear minimises nothing that Ceres could.
    CHECK(rows[3].digests == plain[3].digests);
    if (isa != core::Isa::Baseline) fused = rows;
  }
}

TEST_CASE("an audited trial says what it should, worked out trial by trial") {
  Solved s;
  const std::size_t t = s.converged();
  REQUIRE(t < 50);
  auto columns = s.columns({t});
  CHECK(columns[RefGapM][0] < 1e-8);
  CHECK(std::fabs(columns[RefObjectiveGap][0]) < 1e-12);
  CHECK(columns[RefConverged][0] == 1.0);
  CHECK(columns[RefSameBasin][0] == 1.0);
  CHECK(columns[RefDisagrees][0] == 0.0);

  SECTION("a step that is not what the solver says is a disagreement") {
    s.solutions.remaining_step_m[t] += 1e-6;
    CHECK(s.columns({t})[RefDisagrees][0] == 1.0);
    s.solutions.remaining_step_m[t] = std::nan("");
    CHECK(s.columns({t})[RefDisagrees][0] == 1.0);
  }
  SECTION("so is an estimate that is not where the solver thinks") {
    s.solutions.estimate[0][t] += 0.02;
    columns = s.columns({t});
    CHECK(columns[RefDisagrees][0] == 1.0);
    CHECK(columns[RefGapM][0] == Approx(0.02).epsilon(1e-6));
    CHECK(columns[RefObjectiveGap][0] > 0.0);
    CHECK(columns[RefSameBasin][0] == 1.0);  // Ceres goes back to the same minimum
  }
  SECTION("a failed trial has no gap, but a reference") {
    s.solutions.status[t] = static_cast<std::uint8_t>(core::Status::IterationLimit);
    columns = s.columns({t});
    CHECK(columns[RefConverged][0] == 1.0);
    CHECK(columns[RefTruthBasin][0] == columns[RefTruthBasin][0]);
    for (const auto metric : {RefGapM, RefObjectiveGap, RefSameBasin, RefDisagrees}) {
      CHECK(std::isnan(columns[metric][0]));
    }
  }
}

TEST_CASE("the audit is a key of the study") {
  CHECK(study({}).audit == 1e-4);
  CHECK(study({"audit=1"}).audit == 1.0);
  const auto hash = [](const char* audit) { return make_plan(study({audit})).header.study_hash; };
  CHECK(hash("audit=0.5") != hash("audit=0.25"));
  CHECK(hash("audit=0.5") == hash("audit=5e-1"));
  for (const char* bad : {"audit=2", "audit=-0.1", "audit=nan", "audit=all"}) {
    CAPTURE(bad);
    CHECK_THROWS_AS(study({bad}), core::InputError);
  }
  CHECK(tests::refusal_of([] {
          study({"audit=2"});
        }).find("audit = 2 is not allowed: audit takes a number from 0 to 1") != std::string::npos);
}

TEST_CASE("the audit survives what solvers survive: fewer points than unknowns, scenes without depth, no noise") {
  for (const char* solver : {"ols", "rrr", "irls", "gn_prior"}) {
    for (const char* v_mode : {"free", "fixed", "prior"}) {
      for (const char* points : {"3", "4"}) {
        INFO(solver << ", v " << v_mode << ", " << points << " points");
        const Study s =
            study({"trials=12", "audit=1.0", "scene.model=pseudorange", std::string("scene.points=") + points,
                   std::string("solver.v_mode=") + v_mode, "noise.range_sigma_m=0.0", "scene.elevation_deg=[0.0, 0.0]",
                   "method.0.name=checked", std::string("method.0.solver=") + solver});
        const auto rows = block(s, core::Isa::Baseline, {0, 12});
        CHECK(rows[0].statistics.trials == 12);
      }
    }
  }
}
