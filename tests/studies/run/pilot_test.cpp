#include "studies/run/pilot.hpp"

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

Pilot pilot_of(const std::string& text, double budget_s, int threads = 1) {
  const Study study = read_study({"pilot", "pilot.toml", "experiment = \"ranging\"\n" + text});
  return run_pilot(study, make_plan(study), budget_s, *thread_queue(threads));
}

/// Trials that take no time, in cells that take long to prepare.
struct SlowToPrepare : Experiment {
  static constexpr std::chrono::milliseconds preparing{50};

  struct Instant : Simulation {
    bool run_block(TrialRange range, Workspace&, Monitor&, results::BlockSink& sink) const override {
      sink.metric(0, 0, std::vector<double>(range.count, 1.0));
      return true;
    }
  };

  std::string_view name() const override { return "slow to prepare"; }
  std::string_view summary() const override { return ""; }
  int version() const override { return 1; }
  std::uint64_t block_trials() const override { return 64; }
  std::span<const Setting> settings() const override { return {}; }
  const results::Schema& schema() const override {
    static const results::Schema schema{{{"m", "1", "", false}}, {}, 0};
    return schema;
  }
  std::string_view example() const override { return ""; }
  std::unique_ptr<const Simulation> prepare(const StudyKey&, const Cell&, std::span<const Method>) const override {
    std::this_thread::sleep_for(preparing);
    return std::make_unique<Instant>();
  }
};

const std::string three_cells =
    "trials = 10000\naudit = 0\n[sweep]\npoints = [4, 6, 8]\n[[method]]\nsolver = \"ols\"\n";

}  // namespace

TEST_CASE("a pilot without time runs one trial of one cell, and still knows what a trial takes") {
  const Pilot pilot = pilot_of(three_cells, 0.0);
  CHECK(pilot.trials == 1);
  CHECK(pilot.seconds_per_trial > 0.0);
}

TEST_CASE("a pilot looks at all cells, each round at four times as many trials, up to a block") {
  const Pilot pilot = pilot_of(three_cells, 60.0);
  CHECK(pilot.trials == 3 * (1 + 4 + 16 + 64 + 256 + 1024 + 4096));
  CHECK(pilot.seconds_per_trial > 0.0);
  CHECK(pilot.predicted_trials.empty());
  REQUIRE(pilot.rows.size() == 6);  // of the solver and the scene
  REQUIRE(pilot.columns.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(pilot.rows[i].statistics.trials == 4096);
    CHECK(pilot.columns[i].cell == pilot.rows[i].cell);
    CHECK(pilot.columns[i].trials == 4096);
  }
}

TEST_CASE("a pilot runs no more trials of a cell than the study, and with more workers than cells all of them") {
  const std::string few = "trials = 20\naudit = 0\n[sweep]\npoints = [4, 6]\n[[method]]\nsolver = \"ols\"\n";
  CHECK(pilot_of(few, 60.0).trials == 2 * (1 + 4 + 16));
  CHECK(pilot_of(few, 60.0, 3).trials == 4 * (1 + 4 + 16));
}

TEST_CASE("a pilot says what the audit of a cell takes, and what a stop rule will ask for") {
  const Pilot plain = pilot_of("trials = 1000\naudit = 0\n[[method]]\nsolver = \"ols\"\n", 0.2);
  const Pilot audited = pilot_of("trials = 1000\n[[method]]\nsolver = \"ols\"\n", 0.2);
  CHECK(audited.seconds_per_cell > plain.seconds_per_cell);
  const Pilot stopped = pilot_of(
      three_cells + "[stop]\nmetric = \"error_m\"\nrelative = 0.01\nmin_trials = 4096\nmax_trials = 1000000\n", 0.2);
  REQUIRE(stopped.predicted_trials.size() == 3);
  for (const std::uint64_t trials : stopped.predicted_trials) {
    CHECK(trials >= 4096);
    CHECK(trials <= 1'003'520);
  }
}

TEST_CASE("what preparing a cell takes is known from the first round, in later ones it may be prepared already") {
  const SlowToPrepare experiment;
  Study study;
  study.experiment = &experiment;
  study.trials = 64;
  study.audit = 0.0;
  Plan plan;
  plan.cells = CellGrid(study);  // one cell, without axes
  plan.header.schema = experiment.schema();
  plan.header.block_trials = experiment.block_trials();
  plan.header.cells.resize(1);
  plan.header.methods.resize(1);
  const Pilot pilot = run_pilot(study, plan, 60.0, *thread_queue(1));
  CHECK(pilot.trials == 1 + 4 + 16 + 64);
  CHECK(pilot.seconds_per_cell >= std::chrono::duration<double>(SlowToPrepare::preparing).count());
}
