#include <string>

#include "results/store/result_file.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

namespace {

/// A folder with a small study whose name needs quotes, and the program as a shell finds it.
struct WithSweep : WorkingFolder {
  WithSweep() {
    write("a study.toml", R"(experiment = "ranging"
trials = 9000
[sweep]
points = [3, 5]
[[method]]
solver = "ols"
)");
    REQUIRE(shell("mkdir bin && ln -s '" RIDGELOC_PROGRAM "' bin/ridgeloc").exit_code == 0);
  }

  /// Runs a command in which `ridgeloc` is the program.
  Outcome with_program(const std::string& command) const { return shell("PATH=\"$PWD/bin:$PATH\"; " + command); }
  std::string digest(const std::string& file) const { return ridgeloc::results::data_digest(path() / file); }
};

}  // namespace

TEST_CASE("the job script of plan computes the shares, and the command in it merges them to the whole") {
  const WithSweep folder;
  const std::string study = "'a study.toml' --trials 20000 --set 'scene.depth_m=[1, 8]' --isa baseline --threads 1";
  const Outcome planned = folder.ridgeloc("plan " + study + " --slurm job.sh --shards 3");
  INFO(planned.error);
  REQUIRE(planned.exit_code == 0);
  CHECK(contains(planned.out, "3 shares; sbatch job.sh, and when all are there: ridgeloc merge "));
  const std::string script = folder.read("job.sh");
  CHECK(script.starts_with("#!/bin/sh\n#SBATCH --array=1-3\n#SBATCH --cpus-per-task=1\n#SBATCH --time=0-00:11:00\n"));
  CHECK(contains(script, "#SBATCH --signal=B:USR1@120\n"));

  for (const char* task : {"1", "2", "3"}) {
    const Outcome outcome = folder.with_program(std::string("SLURM_ARRAY_TASK_ID=") + task + " sh job.sh");
    INFO(outcome.error);
    REQUIRE(outcome.exit_code == 0);
  }
  const Outcome merged = folder.with_program("eval \"$(sed -n 's/^#   ridgeloc merge/ridgeloc merge/p' job.sh)\"");
  INFO(merged.error);
  REQUIRE(merged.exit_code == 0);
  CHECK(contains(merged.error, "complete: 2 cells with 20000 trials each"));
  REQUIRE(folder.ridgeloc("run " + study + " -o whole.h5").exit_code == 0);
  CHECK(folder.digest("a study.h5") == folder.digest("whole.h5"));
}

TEST_CASE("a job script without --shards has a share for each hour, and two at least") {
  const WithSweep folder;
  REQUIRE(folder.ridgeloc("plan 'a study.toml' --slurm short.sh").exit_code == 0);
  CHECK(contains(folder.read("short.sh"), "--array=1-2\n"));
  REQUIRE(folder.ridgeloc("plan 'a study.toml' --trials 1e12 --threads 1 --slurm long.sh").exit_code == 0);
  CHECK_FALSE(contains(folder.read("long.sh"), "--array=1-2\n"));
}

TEST_CASE("plan writes no job script that could not work") {
  const WithSweep folder;
  folder.write("stop.toml",
               folder.read("a study.toml") + "[stop]\nmetric = \"error_m\"\ntarget = 1\nmax_trials = 90000\n");
  folder.write("result.h5", "\x89HDF\r\n\x1a\n and more");
  const auto before = folder.entries();
  const auto [arguments, message] = GENERATE(table<std::string, std::string>({
      {"stop.toml --slurm job.sh", "remove [stop]"},
      {"fig3a fig3bcd --slurm job.sh", "one study"},
      {"fig3a --shards 3", "--slurm"},
      {"fig3a --slurm job.sh --shards 1", "--shards"},
      {"fig3a --slurm job.sh --shards 1000001", "--shards"},
      {"fig3a --slurm nowhere/job.sh", "nowhere"},
      {"fig3a --slurm result.h5", "is not replaced"},
  }));
  INFO("ridgeloc plan " << arguments);
  const Outcome outcome = folder.ridgeloc("plan " + arguments);
  INFO(outcome.error);
  CHECK(outcome.exit_code == 2);
  CHECK(line_count(outcome.error) == 1);
  CHECK(contains(outcome.error, message));
  CHECK(folder.entries() == before);
}
