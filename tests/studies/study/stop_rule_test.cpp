#include "studies/study/stop_rule.hpp"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <thread>

#include "results/store/result_file.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/files/study_writer.hpp"
#include "studies/registry.hpp"
#include "studies/run/runner.hpp"
#include "studies/run/stop_rounds.hpp"
#include "studies/study/capabilities.hpp"
#include "studies/study/unmet_cells.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
namespace fs = std::filesystem;

namespace {

const std::string head = R"(
experiment = "ranging"
trials = 4000
[sweep]
points = [4, 7]
range_sigma_m = [0.1, 0.5]
[[method]]
solver = "rr"
[[method]]
solver = "rrr"
[stop]
)";

Study study(const std::string& stop) {
  return read_study({"s", "s.toml", head + stop});
}

std::string refusal(const std::string& stop) {
  return tests::refusal_of([&] { study(stop); });
}

/// A result file that goes with the object.
struct File {
  const tests::ScratchFolder folder;
  const fs::path path = folder / "result.h5";
  void remove() const {
    fs::remove(path);
    fs::remove_all(path.string() + ".parts");
  }
};

RunOutcome run(const Study& s, const fs::path& output, int threads, const std::atomic<bool>& stop,
               RunProgress& progress) {
  const Plan plan = make_plan(s);
  return run_study(s, plan, everything(plan), results::ResultClaim(output), *thread_queue(threads), {}, progress, stop);
}

/// The digest of a result whose run was stopped after so many blocks, and went on with other threads.
std::string digest_when_stopped(const Study& s, const File& file, std::uint64_t blocks) {
  file.remove();
  std::atomic<bool> stop{false};
  RunProgress progress;
  std::jthread watcher([&](const std::stop_token& done) {
    while (progress.blocks_done.load() < blocks && !done.stop_requested()) std::this_thread::yield();
    stop.store(true);
  });
  run(s, file.path, 1, stop, progress);
  watcher.request_stop();
  watcher.join();
  const std::atomic<bool> never{false};
  RunProgress rest;
  CHECK(run(s, file.path, 2, never, rest).sealed);
  return results::data_digest(file.path);
}

const std::string precise = "metric = \"error_all_m\"\nmethods = \"rrr\"\nrelative = 0.02\nmax_trials = 400000\n";

}  // namespace

TEST_CASE("looks begin at the smallest number of trials, grow by 19 % or a block, and end at the largest") {
  StopRule rule;
  rule.min_trials = 5000;
  rule.max_trials = 100'000;
  CHECK(looks(rule, 4096) == std::vector<std::uint64_t>{2, 3, 4, 5, 6, 8, 10, 12, 15, 18, 22, 25});
  rule.max_trials = 5000;
  CHECK(looks(rule, 4096) == std::vector<std::uint64_t>{2});
}

TEST_CASE("the trials that a cell needs follow from those that it has") {
  StopRule rule;
  rule.min_trials = 1;
  rule.max_trials = 1'000'000;
  CHECK(predicted_trials(rule, {0.5, true}, 4096, 4096) == 4096);
  CHECK(predicted_trials(rule, {2.0, true}, 4096, 4096) == 4 * 4096);  // a look; the root of the trials rules
  CHECK(predicted_trials(rule, {2.1, true}, 4096, 4096) == 5 * 4096);
  CHECK(predicted_trials(rule, {1e9, true}, 4096, 4096) == 1'000'000);
  CHECK(predicted_trials(rule, {std::nan(""), true}, 4096, 4096) == 1'000'000);
}

TEST_CASE("every cell stops at the first look at which it is known well enough, the same for any threads") {
  const Study s = study(precise);
  const File file;
  const std::atomic<bool> never{false};
  std::string digest;
  for (const int threads : {1, 2, 5}) {
    file.remove();
    RunProgress progress;
    CHECK(run(s, file.path, threads, never, progress).sealed);
    const std::string now = results::data_digest(file.path);
    CHECK((digest.empty() || digest == now));
    digest = now;
  }
  const results::Summary summary = results::read_result(file.path);
  const auto blocks = looks(*s.stop, 4096);
  for (std::size_t cell = 0; cell < 4; ++cell) {
    CAPTURE(cell);
    const auto row = results::summary_row(summary.header, 1, summary.of(cell, 1), "error_all_m");
    CHECK(row.mcse <= 0.02 * row.mean);
    CHECK(row.trusted);
    const std::uint64_t trials = summary.of(cell, 1).trials;
    CHECK(trials % 4096 == 0);
    CHECK(std::ranges::find(blocks, trials / 4096) != blocks.end());
    CHECK(summary.of(cell, 0).trials == trials);
  }
  RunProgress progress;
  CHECK(run(s, file.path, 1, never, progress).unchanged);
}

TEST_CASE("a stop rule that was interrupted ends in the same bytes") {
  const Study s = study(precise);
  const File file;
  const std::atomic<bool> never{false};
  RunProgress whole;
  run(s, file.path, 2, never, whole);
  const std::string digest = results::data_digest(file.path);
  for (const std::uint64_t blocks : {1, 5, 9, 14}) {
    CAPTURE(blocks);
    CHECK(digest_when_stopped(s, file, blocks) == digest);
  }
}

TEST_CASE("a cell is worth its squared error per cost, and first of all where the error is not known") {
  CHECK(priority({2.0, true}, 100.0) == 0.04);
  CHECK(priority({2.0, true}, 100.0) > priority({2.0, true}, 200.0));
  CHECK(priority({2.0, true}, 100.0) < priority({3.0, true}, 200.0));
  CHECK(priority({0.5, false}, 100.0) == 0.01);
  CHECK(std::isinf(priority({std::nan(""), true}, 100.0)));
}

TEST_CASE("methods have a cost, or the labels of an experiment without any") {
  const auto costs = [](const Study& s) {
    const results::Header header = make_plan(s).header;
    std::vector<std::string> labels;
    for (std::size_t m = 0; m < header.methods.size(); ++m)
      if (has_cost(s, header, m)) labels.push_back(header.methods[m].label);
    return labels;
  };
  const Study compared = study(precise);
  CHECK(make_plan(compared).header.methods.size() > 3);
  CHECK(costs(compared) == std::vector<std::string>{"rr", "rrr"});
  CHECK(costs(read_study({"s", "s.toml", "experiment = \"detection\"\n"})) == std::vector<std::string>{"detector"});
}

TEST_CASE("a limit of the cost is spent in the same way by any threads, interrupted or not") {
  // Five times what the first looks cost, and no cell reaches its target.
  const Study s =
      study("metric = \"error_all_m\"\nmethods = \"rrr\"\nrelative = 1e-6\nmax_trials = 4000000\nmax_cost = 8e6\n");
  const File file;
  const std::atomic<bool> never{false};
  std::string digest;
  for (const int threads : {1, 2, 5}) {
    file.remove();
    RunProgress progress;
    CHECK(run(s, file.path, threads, never, progress).sealed);
    const std::string now = results::data_digest(file.path);
    CHECK((digest.empty() || digest == now));
    digest = now;
  }
  const results::Summary summary = results::read_result(file.path);
  const auto cost = [&](std::size_t cell) {
    double sum = 0.0;
    for (std::size_t method = 0; method < 2; ++method)
      sum += cost_of(*s.experiment, make_plan(s).cells[cell].values, summary.of(cell, method));
    return sum;
  };
  double spent = 0.0;
  double most = 0.0;
  for (std::size_t cell = 0; cell < 4; ++cell) {
    spent += cost(cell);
    most = std::max(most, cost(cell));
  }
  CHECK(spent >= 8e6);
  CHECK(spent < 8e6 + most);
  // Points 4 and 7, of which the latter needs more trials for the same relative error.
  CHECK(summary.of(2, 1).trials > summary.of(1, 1).trials);
  for (const std::uint64_t blocks : {2, 7, 12}) {
    CAPTURE(blocks);
    CHECK(digest_when_stopped(s, file, blocks) == digest);
  }
  RunProgress progress;
  CHECK(run(s, file.path, 1, never, progress).unchanged);
}

TEST_CASE("what cannot be reached ends at the largest number of trials") {
  const Study s = study("metric = \"converged\"\ntarget = 1e-9\nmin_trials = 1\nmax_trials = 9000\n");
  const File file;
  const std::atomic<bool> never{false};
  RunProgress progress;
  run(s, file.path, 2, never, progress);
  const results::Summary summary = results::read_result(file.path);
  for (std::size_t cell = 0; cell < 4; ++cell) CHECK(summary.of(cell, 0).trials == 9000);
}

TEST_CASE("cells that end without their target are found, with how far they are from it") {
  const std::string rule = "metric = \"error_all_m\"\nmethods = \"rrr\"\nrelative = 0.02\nmin_trials = 4000\n";
  const Study s = study(rule + "max_trials = 9000\n");
  const File file;
  const std::atomic<bool> never{false};
  RunProgress progress;
  run(s, file.path, 2, never, progress);
  const results::Summary summary = results::read_result(file.path);
  const auto unmet = unmet_cells(*s.stop, summary);
  std::size_t next = 0;
  for (std::size_t cell = 0; cell < 4; ++cell) {
    const auto row = results::summary_row(summary.header, 1, summary.of(cell, 1), "error_all_m");
    if (row.trusted && row.mcse <= 0.02 * row.mean) {
      CHECK(row.n <= 9000);
      continue;
    }
    REQUIRE(next < unmet.size());
    CHECK(unmet[next].cell == cell);
    CHECK(unmet[next].trials == 9000);
    CHECK(unmet[next++].precision.error_over_target == Approx(row.mcse / (0.02 * row.mean)));
  }
  CHECK(next == unmet.size());
  CHECK(!unmet.empty());
  // With more trials the same file goes on, as if it had never ended in the middle of a block.
  const Study more = study(rule + "max_trials = 40000\n");
  RunProgress rest;
  CHECK(run(more, file.path, 2, never, rest).sealed);
  const File fresh;
  RunProgress whole;
  CHECK(run(more, fresh.path, 1, never, whole).sealed);
  CHECK(results::data_digest(file.path) == results::data_digest(fresh.path));
  CHECK(unmet_cells(*more.stop, results::read_result(file.path)).size() < unmet.size());
}

TEST_CASE("a stop rule is written and read again; its errors say what is allowed") {
  const Study s = study(precise);
  CHECK(resolved_toml(read_study({"s", "s.toml", resolved_toml(s)})) == resolved_toml(s));
  CHECK(make_plan(s).header.study_hash ==
        make_plan(read_study({"s", "s.toml", head.substr(0, head.size() - 7)})).header.study_hash);
  CHECK(refusal("metric = \"error\"\ntarget = 1\nmax_trials = 9000\n").find("did you mean \"error_m\"") !=
        std::string::npos);
  CHECK(refusal("target = 1\nmax_trials = 9000\n").find("[stop] lacks metric") != std::string::npos);
  CHECK(refusal("metric = \"error_m\"\nmax_trials = 9000\n").find("either target") != std::string::npos);
  CHECK(refusal("metric = \"error_m\"\ntarget = 1\nrelative = 1\nmax_trials = 9000\n").find("either target") !=
        std::string::npos);
  CHECK(refusal("metric = \"error_m\"\ntarget = 0\nmax_trials = 9000\n").find("stop.target = 0 is not allowed") !=
        std::string::npos);
  CHECK(refusal("metric = \"error_m\"\ntarget = 1\n").find("[stop] lacks max_trials") != std::string::npos);
  CHECK(refusal("metric = \"error_m\"\ntarget = 1\nmax_trials = 9000\nmax_cost = 0\n")
            .find("stop.max_cost = 0 is not allowed") != std::string::npos);
  const Study limited = study(precise + "max_cost = 2e6\n");
  CHECK(limited.stop->max_cost == 2e6);
  CHECK(resolved_toml(read_study({"s", "s.toml", resolved_toml(limited)})) == resolved_toml(limited));
  CHECK(refusal("metric = \"error_m\"\ntarget = 1\nmax_trials = 3999\n").find("from 4000") != std::string::npos);
  CHECK(refusal("metric = \"error_m\"\ntarget = 1\nmax_trials = 9000\nmethods = \"ols\"\n").find("methods") !=
        std::string::npos);
}
