#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

namespace {

std::string study(const std::string& stop) {
  return "experiment = \"ranging\"\naudit = 0\n[sweep]\npoints = [4, 7]\n[[method]]\nsolver = \"rrr\"\n[stop]\n"
         "metric = \"iterations\"\nmin_trials = 1000\n" +
         stop;
}

}  // namespace

TEST_CASE("cells that end without their target are named by run, verify and summary, and trials end at the maximum") {
  const WorkingFolder folder;
  folder.write("s.toml", study("relative = 1e-9\nmax_trials = 5000\n"));
  const Outcome run = folder.ridgeloc("run s.toml");
  CHECK(run.exit_code == 0);
  const std::string unmet =
      "2 of 2 cells have not reached the target (standard error of the mean of iterations at most 1e-07 %): points = "
      "4: ";
  CHECK(contains(run.error, "s: " + unmet));
  CHECK(contains(run.error, " times the target after 5000 trials; points = 7: "));
  const Outcome verify = folder.ridgeloc("verify s.h5");
  CHECK(verify.exit_code == 0);
  CHECK(contains(verify.out, "complete: 2 cells with 1000 to 5000 trials each"));
  CHECK(contains(verify.out, "stop         " + unmet));
  for (const std::string options : {"", " --all"}) {
    const Outcome summary = folder.ridgeloc("summary s.h5" + options);
    CHECK(summary.exit_code == 0);
    CHECK(contains(summary.out, "stop: 2 of 2 cells have not reached the target"));
  }
}

TEST_CASE("a target that is reached is said too, and a study without one says nothing of it") {
  const WorkingFolder folder;
  folder.write("s.toml", study("relative = 0.5\nmax_trials = 5000\n"));
  CHECK_FALSE(contains(folder.ridgeloc("run s.toml").error, "target"));
  CHECK(contains(folder.ridgeloc("verify s.h5 --blocks 0").out,
                 "stop         all cells have reached the target (standard error of the mean of iterations at most "
                 "50 %)"));
  REQUIRE(folder.ridgeloc("run fig3a --trials 20 -o f.h5").exit_code == 0);
  CHECK_FALSE(contains(folder.ridgeloc("verify f.h5 --blocks 0").out, "target"));
  CHECK_FALSE(contains(folder.ridgeloc("summary f.h5").out, "stop:"));
}

TEST_CASE("a plan with a stop rule says what is expected and what it is at most") {
  const WorkingFolder folder;
  folder.write("s.toml", study("target = 1e-9\nmax_trials = 1e6\n"));
  const std::string plan = folder.ridgeloc("plan s.toml --threads 2").out;
  CHECK(contains(plan, "trials   about 2000000 (1000000 per cell), at most 2000000\n"));
  CHECK(contains(plan, ", at most "));
  CHECK(contains(plan, ", on 2 threads"));
  CHECK(
      contains(plan, "stop     standard error of the mean of iterations at most 1e-09, after 1000 to 1000000 trials"));
}
