// What `plan` says of the room and the time that a study takes.

#include <regex>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

namespace {

const std::string study = R"(experiment = "ranging"
audit = 0
[sweep]
points = [3, 5]
[[method]]
solver = "ols"
)";

/// Bytes that a plan names in the line "disk".
double bytes_of(const std::string& plan) {
  std::smatch found;
  REQUIRE(std::regex_search(plan, found, std::regex("disk +about ([0-9.]+) ([KM])iB")));
  return std::stod(found[1]) * (found[2] == "K" ? 1024.0 : 1048576.0);
}

}  // namespace

TEST_CASE("a plan says of how many trials values are kept, and run does where it is not all") {
  const WorkingFolder folder;
  folder.write("s.toml", study);
  const auto plan = [&](const std::string& options) { return folder.ridgeloc("plan s.toml " + options).out; };
  CHECK(contains(plan("--trials 1000"), "kept     the values of all trials: "));
  const std::regex some(
      "kept     the values of the first ([0-9]+) trials of each cell: [0-9.]+ [KM]iB, at most 1 MiB\n");
  std::smatch kept;
  const std::string text = plan("--trials 100000 --set store.trial_columns_mib=1");
  INFO(text);
  REQUIRE(std::regex_search(text, kept, some));
  CHECK(contains(plan("--set store.trial_columns_mib=0"), "kept     no values of single trials\n"));

  const Outcome run = folder.ridgeloc("run s.toml --trials 100000 --set store.trial_columns_mib=1 -o s.h5");
  CHECK(contains(run.error, "s: keeps the values of the first " + kept[1].str() +
                                " of 100000 trials of each cell, at most 1 MiB in all ([store] trial_columns_mib)\n"));
  CHECK_FALSE(contains(folder.ridgeloc("run s.toml --trials 1000 -o all.h5").error, "keeps"));
}

TEST_CASE("a size that is too small for a single trial of each cell is said by plan and run") {
  const WorkingFolder folder;
  folder.write("s.toml", study);
  const std::string tiny = " --trials 10 --set store.trial_columns_mib=1e-5";
  const std::string said = "no values of single trials: one of each cell takes ";
  CHECK(contains(folder.ridgeloc("plan s.toml" + tiny).out, "  kept     " + said));
  CHECK(contains(folder.ridgeloc("run s.toml" + tiny).error, "s: keeps " + said));
  const std::string none = " --trials 20 --set store.trial_columns_mib=0 -o none.h5";
  CHECK_FALSE(contains(folder.ridgeloc("run s.toml" + none).error, "keeps"));
}

TEST_CASE("a plan says which axes are zipped and how many cells are excluded") {
  const WorkingFolder folder;
  folder.write("s.toml", R"(experiment = "ranging"
[sweep]
points = [3, 5, 5]
range_sigma_m = [0.1, 0.1, 0.3]
start_offset_m = [1, 5]
zip = [["points", "range_sigma_m"]]
exclude = [{ points = 3, start_offset_m = 5 }]
[[method]]
solver = "ols"
)");
  const std::string plan = folder.ridgeloc("plan s.toml").out;
  INFO(plan);
  CHECK(contains(plan, "  axis     points (3 values), zipped with range_sigma_m\n"));
  CHECK(contains(plan, "  axis     range_sigma_m (3 values), zipped with points\n"));
  CHECK(contains(plan, "  axis     start_offset_m (2 values)\n"));
  CHECK(contains(plan, "  cells    5, 1 excluded\n"));
}

TEST_CASE("a result is about as large as its plan says") {
  const WorkingFolder folder;
  folder.write("s.toml", study);
  for (const char* options : {"--trials 20", "--trials 20000", "--trials 20000 --set store.trial_columns_mib=1"}) {
    CAPTURE(options);
    const double planned = bytes_of(folder.ridgeloc(std::string("plan s.toml ") + options).out);
    REQUIRE(folder.ridgeloc(std::string("run s.toml -o s.h5 ") + options).exit_code == 0);
    const double size = std::stod(folder.shell("stat -c %s s.h5; rm s.h5").out);
    CHECK(planned < 1.5 * size);
    CHECK(size < 1.5 * planned);
  }
}

TEST_CASE("a plan needs no folder for temporary files, and says what it does not reckon without") {
  const WorkingFolder folder;
  folder.write("s.toml", study);
  for (const char* unusable : {"nowhere", "/proc"}) {
    const Outcome plan = folder.shell(std::string("TMPDIR=") + unusable + " '" RIDGELOC_PROGRAM "' plan s.toml");
    INFO(plan.out << plan.error);
    CHECK(plan.exit_code == 0);
    CHECK(contains(plan.out, "  trials   "));
    CHECK(contains(plan.out, "  note     writing is not reckoned: "));
  }
  CHECK_FALSE(contains(folder.ridgeloc("plan s.toml").out, "reckoned"));
}

TEST_CASE("a run says of which trials it drops the values, and of a stop rule how many it keeps of the most") {
  const WorkingFolder folder;
  folder.write("s.toml", study);
  const std::string run = "run s.toml --trials 100000 --set store.trial_columns_mib=1 -o s.h5";
  REQUIRE_FALSE(contains(folder.ridgeloc(run).error, "drops"));
  const std::string wider = folder.ridgeloc(run + " --set sweep.points=[3,5,7]").error;
  INFO(wider);
  CHECK(std::regex_search(wider, std::regex("s.h5: drops the values of [0-9]+ trials per cell, of up to [0-9]+ that "
                                            "are there; a larger \\[store\\] trial_columns_mib keeps them\n")));
  CHECK_FALSE(contains(folder.ridgeloc(run + " --set sweep.points=[3,5,7]").error, "drops"));
  folder.write("stop.toml", study +
                                "[store]\ntrial_columns_mib = 1\n[stop]\nmetric = \"iterations\"\ntarget = 10\n"
                                "min_trials = 1000\nmax_trials = 1e6\n");
  CHECK(contains(folder.ridgeloc("run stop.toml").error, " of at most 1000000 trials of each cell"));
}

TEST_CASE("a plan of more than a year says that it is") {
  const WorkingFolder folder;
  folder.write("s.toml", study);
  // 2 * 10^15 trials.
  const std::string plan =
      folder.ridgeloc("plan s.toml --trials 1e12 --set 'sweep.range_sigma_m={from=0.1,to=100,step=0.1}'").out;
  INFO(plan);
  CHECK(contains(plan, "  note     that is more than a year: "));
  CHECK_FALSE(contains(folder.ridgeloc("plan s.toml").out, "year"));
}
