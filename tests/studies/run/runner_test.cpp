#include "studies/run/runner.hpp"

#include <algorithm>
#include <filesystem>
#include <thread>

#include "core/error.hpp"
#include "results/store/result_file.hpp"
#include "results/store/result_merge.hpp"
#include "results/store/snapshot.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/metric_of.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

namespace fs = std::filesystem;

const std::atomic<bool> never{false};

Study study(const std::vector<std::string>& overrides = {}) {
  return read_study({"demo", "demo.toml", R"(
experiment = "ranging"
trials = 10000
[store]
trial_columns_mib = 4
[sweep]
points = [3, 5]
range_sigma_m = [0.1, 0.5]
[[method]]
solver = "rrr"
[[method]]
solver = "rr"
k = "oracle_elem"
similarity = 0.7
)"},
                    overrides);
}

RunOutcome run(const Study& s, const fs::path& output, int threads, const std::atomic<bool>& stop = never) {
  RunProgress progress;
  const Plan plan = make_plan(s);
  return run_study(s, plan, everything(plan), results::ResultClaim(output), *thread_queue(threads), {}, progress, stop);
}

}  // namespace

TEST_CASE("a result holds the same bytes for 1, 2 and 5 threads") {
  const tests::ScratchFolder folder;
  const Study s = study();
  std::string digest;
  for (const int threads : {1, 2, 5}) {
    const fs::path output = folder / "out.h5";
    fs::remove(output);
    CHECK(run(s, output, threads).sealed);
    const std::string now = results::data_digest(output);
    CHECK((digest.empty() || digest == now));
    digest = now;
    CHECK_FALSE(fs::exists(output.string() + ".parts"));
  }
}

TEST_CASE("another seed gives another result") {
  const tests::ScratchFolder folder;
  run(study({"trials=100"}), folder / "a.h5", 1);
  run(study({"trials=100", "seed=2"}), folder / "b.h5", 1);
  CHECK(results::data_digest(folder / "a.h5") != results::data_digest(folder / "b.h5"));
}

TEST_CASE("a stopped run is taken up where it stopped, and ends in the same bytes") {
  const tests::ScratchFolder folder;
  const Study s = study();
  const Plan plan = make_plan(s);
  run(s, folder / "whole.h5", 2);

  // Stop after the first blocks: the flag is raised while the run is under way.
  std::atomic<bool> stop{false};
  RunProgress progress;
  std::jthread watcher([&](const std::stop_token& done) {
    while (progress.blocks_done.load() < 3 && !done.stop_requested()) std::this_thread::yield();
    stop.store(true);
  });
  const RunOutcome first = run_study(s, plan, everything(plan), results::ResultClaim(folder / "stopped.h5"),
                                     *thread_queue(1), {}, progress, stop);
  watcher.request_stop();
  watcher.join();
  REQUIRE_FALSE(first.sealed);
  CHECK(first.blocks_kept == first.blocks_run);
  CHECK_FALSE(fs::exists(folder / "stopped.h5"));
  CHECK(fs::exists(folder / "stopped.h5.parts"));

  const RunOutcome second = run(s, folder / "stopped.h5", 2);
  CHECK(second.sealed);
  CHECK(second.blocks_found == first.blocks_run);
  CHECK(second.blocks_found + second.blocks_run == everything(plan).blocks());
  CHECK(results::data_digest(folder / "stopped.h5") == results::data_digest(folder / "whole.h5"));
}

TEST_CASE("a run that is stopped has something of every cell, and never much more of one than of another") {
  const tests::ScratchFolder folder;
  const Study s = study({"trials=400000", "store.trial_columns_mib=0"});
  const Plan plan = make_plan(s);
  const int threads = GENERATE(1, 3);
  std::atomic<bool> stop{false};
  RunProgress progress;
  std::jthread watcher([&] {
    while (progress.blocks_done.load() < 40) std::this_thread::yield();
    stop.store(true);
  });
  const RunOutcome outcome = run_study(s, plan, everything(plan), results::ResultClaim(folder / "stopped.h5"),
                                       *thread_queue(threads), {}, progress, stop);
  watcher.join();
  REQUIRE_FALSE(outcome.sealed);
  const results::Summary summary = results::summarize(results::read_snapshot(folder / "stopped.h5"));
  std::uint64_t fewest = s.trials;
  std::uint64_t most = 0;
  for (std::size_t cell = 0; cell < plan.cells.size(); ++cell) {
    fewest = std::min(fewest, summary.of(cell, 0).trials);
    most = std::max(most, summary.of(cell, 0).trials);
  }
  CHECK(fewest > 0);
  // A piece, four blocks of 4096 trials, for each worker that was under way.
  CHECK(most <= 2 * fewest + 2 * static_cast<std::uint64_t>(threads) * 4 * 4096);
}

TEST_CASE("a result topped up in any steps, or merged from shares, holds the same bytes") {
  const tests::ScratchFolder folder;
  run(study(), folder / "whole.h5", 2);
  const std::string whole = results::data_digest(folder / "whole.h5");

  for (const int steps : {2, 10}) {
    CAPTURE(steps);
    fs::remove(folder / "steps.h5");
    for (int step = 1; step <= steps; ++step)
      run(study({"trials=" + std::to_string(10000 * step / steps)}), folder / "steps.h5", 1);
    CHECK(results::data_digest(folder / "steps.h5") == whole);
  }

  const Study s = study();
  const Plan plan = make_plan(s);
  for (const std::uint64_t count : {3, 7}) {
    CAPTURE(count);
    std::vector<fs::path> shares;
    for (std::uint64_t number = count; number >= 1; --number) {
      shares.push_back(folder / ("share" + std::to_string(number) + ".h5"));
      fs::remove(shares.back());
      RunProgress progress;
      run_study(s, plan, assignment_of(plan, plan, {number, count}), results::ResultClaim(shares.back()),
                *thread_queue(2), {}, progress, never);
    }
    fs::remove(folder / "merged.h5");
    results::merge_results(shares, folder / "merged.h5", plan.header, {});
    CHECK(results::data_digest(folder / "merged.h5") == whole);
  }
}

TEST_CASE("a wider study computes only what its result lacks, and ends in the same bytes") {
  const tests::ScratchFolder folder;
  run(study(), folder / "whole.h5", 2);
  // One method and one value of an axis less.
  const Study narrow = read_study({"demo", "demo.toml", R"(
experiment = "ranging"
trials = 10000
[store]
trial_columns_mib = 4
[sweep]
points = [3, 5]
range_sigma_m = [0.5]
[[method]]
solver = "rrr"
)"});
  const Study wide = study();
  const Plan plan = make_plan(wide);
  run(narrow, folder / "grown.h5", 2);
  RunProgress progress;
  const RunOutcome outcome = run_study(wide, plan, everything(plan), results::ResultClaim(folder / "grown.h5"),
                                       *thread_queue(2), {}, progress, never);
  CHECK(outcome.sealed);
  CHECK(outcome.blocks_run == 12);  // cells that are there lack a method and its difference to the first
  CHECK(results::data_digest(folder / "grown.h5") == results::data_digest(folder / "whole.h5"));

  const RunOutcome again = run(wide, folder / "grown.h5", 2);
  CHECK(again.unchanged);
  CHECK(again.blocks_found == 12);
}

TEST_CASE("results of narrower studies, which keep more trials of each cell, merge to the same bytes") {
  const tests::ScratchFolder folder;
  run(study(), folder / "whole.h5", 2);
  const Plan plan = make_plan(study());
  std::vector<fs::path> halves;
  for (const char* sigma : {"0.5", "0.1"}) {
    const Study half = study({std::string("sweep.range_sigma_m=[") + sigma + "]"});
    CHECK(make_plan(half).header.kept_trials > plan.header.kept_trials);
    halves.push_back(folder / (std::string(sigma) + ".h5"));
    run(half, halves.back(), 1);
  }
  results::merge_results(halves, folder / "merged.h5", plan.header, {});
  CHECK(results::data_digest(folder / "merged.h5") == results::data_digest(folder / "whole.h5"));
  CHECK(results::read_trials(folder / "merged.h5", 2, 0).trial.size() == plan.header.kept_trials);
}

TEST_CASE("totals do not depend on how trials were cut into calls of the experiment") {
  // The first 5000 trials of a study of 10000 are the trials of a study of 5000.
  const tests::ScratchFolder folder;
  run(study({"trials=5000"}), folder / "half.h5", 1);
  run(study(), folder / "whole.h5", 1);
  const auto half = results::read_trials(folder / "half.h5", 3, 0);
  const auto whole = results::read_trials(folder / "whole.h5", 3, 0);
  REQUIRE(half.trial.size() == make_plan(study()).header.kept_trials);
  CHECK(half.status == whole.status);
  const std::size_t error = tests::metric_of(study(), "error_all_m");
  CHECK(half.metrics[error] == whole.metrics[error]);
}

TEST_CASE("every trial is accounted for, per cell and method, by exactly one status") {
  const tests::ScratchFolder folder;
  const Study s = study({"trials=3000"});
  run(s, folder / "out.h5", 2);
  const results::Summary summary = results::read_result(folder / "out.h5");
  REQUIRE(summary.header.cells.size() == 4);
  for (std::size_t cell = 0; cell < 4; ++cell) {
    for (std::size_t method = 0; method < 2; ++method) {
      const auto& events = summary.of(cell, method).events;
      std::uint64_t total = 0;
      for (std::size_t status = 0; status < summary.header.schema.statuses; ++status) total += events[status];
      CHECK(total == 3000);
      const auto& errors = summary.of(cell, method).metrics[tests::metric_of(s, "error_m")];
      CHECK(errors.moments.n == events[0]);  // of the converged
    }
  }
}

TEST_CASE("an output that cannot be written is refused before anything is computed") {
  const tests::ScratchFolder folder;
  CHECK_THROWS_AS(run(study(), folder / "missing/out.h5", 1), core::InputError);
  CHECK_FALSE(fs::exists(folder / "missing"));
}

TEST_CASE("the difference of two methods is that of their means where all trials count, and varies less") {
  const tests::ScratchFolder folder;
  run(study({"trials=3000"}), folder / "out.h5", 2);
  const results::Summary summary = results::read_result(folder / "out.h5");
  REQUIRE(summary.header.methods.size() == 4);
  REQUIRE(summary.header.methods[3].label == "rr - rrr");
  REQUIRE(summary.header.methods[3].difference == std::array<std::size_t, 2>{1, 0});
  const auto iterations = [&](std::size_t cell, std::size_t method) {
    return summary.of(cell, method).metrics[tests::metric_of(study(), "iterations")].moments;
  };
  for (std::size_t cell = 0; cell < 4; ++cell) {
    CHECK(iterations(cell, 3).n == 3000);
    CHECK(iterations(cell, 3).mean == Approx(iterations(cell, 1).mean - iterations(cell, 0).mean).margin(1e-12));
  }
}

TEST_CASE("a comparison that is asked for later computes its methods again, and changes nothing else") {
  const tests::ScratchFolder folder;
  run(study(), folder / "whole.h5", 2);
  run(study({"compare=[]"}), folder / "grown.h5", 2);
  CHECK(results::read_result_header(folder / "grown.h5").methods.size() == 3);
  CHECK(run(study(), folder / "grown.h5", 2).blocks_run == 12);
  CHECK(results::data_digest(folder / "grown.h5") == results::data_digest(folder / "whole.h5"));
}
