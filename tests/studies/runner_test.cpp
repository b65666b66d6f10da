#include "studies/runner.hpp"

#include <unistd.h>

#include <filesystem>
#include <thread>

#include "catch.hpp"
#include "core/error.hpp"
#include "results/result_file.hpp"
#include "studies/study_reader.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, removed at its end.
class Folder {
 public:
  Folder() { fs::create_directories(path_); }
  ~Folder() { fs::remove_all(path_); }
  fs::path operator/(const char* name) const { return path_ / name; }

 private:
  fs::path path_ = fs::temp_directory_path() / ("ridgeloc-runner-test-" + std::to_string(getpid()));
};

const std::atomic<bool> never{false};

Study study(const std::vector<std::string>& overrides = {}) {
  return read_study({"demo", "demo.toml", R"(
experiment = "ranging"
trials = 10000
[store]
trial_columns_mib = 1.75
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
  return run_study(s, make_plan(s), output, threads, {}, progress, stop);
}

}  // namespace

TEST_CASE("a result holds the same bytes for 1, 2 and 5 threads") {
  const Folder folder;
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
  const Folder folder;
  run(study({"trials=100"}), folder / "a.h5", 1);
  run(study({"trials=100", "seed=2"}), folder / "b.h5", 1);
  CHECK(results::data_digest(folder / "a.h5") != results::data_digest(folder / "b.h5"));
}

TEST_CASE("a stopped run is taken up where it stopped, and ends in the same bytes") {
  const Folder folder;
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
  const RunOutcome first = run_study(s, plan, folder / "stopped.h5", 1, {}, progress, stop);
  watcher.request_stop();
  watcher.join();
  REQUIRE_FALSE(first.sealed);
  CHECK_FALSE(fs::exists(folder / "stopped.h5"));
  CHECK(fs::exists(folder / "stopped.h5.parts"));

  const RunOutcome second = run(s, folder / "stopped.h5", 2);
  CHECK(second.sealed);
  CHECK(second.blocks_found == first.blocks_run);
  CHECK(second.blocks_found + second.blocks_run == plan.blocks_per_cell * plan.cells.size());
  CHECK(results::data_digest(folder / "stopped.h5") == results::data_digest(folder / "whole.h5"));
}

TEST_CASE("totals do not depend on how trials were cut into calls of the experiment") {
  // The first 5000 trials of a study of 10000 are the trials of a study of 5000.
  const Folder folder;
  run(study({"trials=5000"}), folder / "half.h5", 1);
  run(study(), folder / "whole.h5", 1);
  const auto half = results::read_trials(folder / "half.h5", 3, 0);
  const auto whole = results::read_trials(folder / "whole.h5", 3, 0);
  REQUIRE(half.trial.size() == 4096);  // one block of columns fits into 1.75 MiB
  CHECK(half.status == whole.status);
  CHECK(half.metrics[1] == whole.metrics[1]);
}

TEST_CASE("every trial is accounted for, per cell and method, by exactly one status") {
  const Folder folder;
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
      CHECK(summary.of(cell, method).metrics[0].moments.n == events[0]);  // error_m: the converged
    }
  }
}

TEST_CASE("an output that cannot be written is refused before anything is computed") {
  const Folder folder;
  CHECK_THROWS_AS(run(study(), folder / "missing/out.h5", 1), core::InputError);
  CHECK_FALSE(fs::exists(folder / "missing"));
}
