// What an experiment gets that offers nothing beyond the contract, and that trials may take long.

#include <chrono>
#include <regex>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

namespace {

/// `ridgeloc` with the experiments "nap", a trial a block, and "sleep", 4096.
Outcome call(const WorkingFolder& folder, const std::string& arguments) {
  return folder.shell("'" SMALLEST_EXPERIMENT "' " + arguments);
}

void write_study(const WorkingFolder& folder, const std::string& experiment, const std::string& nap_ms, int trials) {
  folder.write("s.toml", "experiment = \"" + experiment + "\"\ntrials = " + std::to_string(trials) +
                             "\n[sweep]\nnap_ms = [" + nap_ms + "]\n[[figure]]\nx = \"nap_ms\"\ny = \"dream\"\n");
}

double seconds_of(const WorkingFolder& folder, const std::string& arguments, Outcome& outcome) {
  const auto begin = std::chrono::steady_clock::now();
  outcome = call(folder, arguments);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

TEST_CASE("every verb works on the smallest experiment") {
  const WorkingFolder folder;
  write_study(folder, "nap", "0.1, 0.2", 40);
  for (const char* arguments :
       {"list experiments", "new nap", "plan s.toml", "run s.toml -o a.h5", "run s.toml --shard 1/2 -o b.h5",
        "run s.toml --shard 2/2 -o c.h5", "summary a.h5", "export a.h5 --csv", "export a.h5 --json",
        "export a.h5 --latex", "export a.h5 --trials", "plot a.h5", "report a.h5 -o a.html", "verify a.h5",
        "merge b.h5 c.h5 -o d.h5", "compare a.h5 d.h5"}) {
    const Outcome outcome = call(folder, arguments);
    INFO(arguments << ": " << outcome.error);
    CHECK(outcome.exit_code == 0);
  }
  CHECK(contains(call(folder, "compare a.h5 d.h5").out, "equal: both hold the same numbers, bit for bit"));
  CHECK(contains(call(folder, "summary a.h5").out, "dream"));
  for (const char* file : {"s.svg", "a.html"}) CHECK(folder.has(file));
}

TEST_CASE("what the smallest experiment does not offer is said in one line") {
  const WorkingFolder folder;
  write_study(folder, "nap", "0.1", 4);
  REQUIRE(call(folder, "run s.toml -o a.h5").exit_code == 0);
  const auto refusal = [&](const std::string& arguments) {
    const Outcome outcome = call(folder, arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(line_count(outcome.error) == 1);
    return outcome.error;
  };
  CHECK(contains(refusal("replay a.h5 --trial 1"), "the experiment \"nap\" offers no replay of a trial"));
  CHECK(contains(refusal("audit a.h5"), "the experiment \"nap\" offers no recount of failures"));
  CHECK(contains(refusal("run s.toml --set audit=0.5 -o b.h5"), "audit"));
  folder.write("m.toml", "experiment = \"nap\"\n[[method]]\nsolver = \"ols\"\n");
  CHECK(contains(refusal("run m.toml -o b.h5"), "has no methods to choose; leave [[method]] out"));
}

TEST_CASE("a run of long trials goes on where it was stopped, trial by trial, and ends in the same bytes") {
  const WorkingFolder folder;
  write_study(folder, "nap", "30", 200);  // 3 s on two threads
  Outcome stopped;
  CHECK(seconds_of(folder, "run s.toml -o a.h5 --threads 2 --time-limit 1s", stopped) < 10.0);
  REQUIRE(stopped.exit_code == 4);
  CHECK(call(folder, "run s.toml -o a.h5 --threads 8").exit_code == 0);
  CHECK(call(folder, "run s.toml -o b.h5 --threads 8").exit_code == 0);
  CHECK(call(folder, "verify --digest a.h5").out == call(folder, "verify --digest b.h5").out);
}

TEST_CASE("a stop takes effect within a trial, whatever the size of the block") {
  // The bounds are twenty times what is needed on an idle machine.
  for (const char* experiment : {"nap", "sleep"}) {
    const WorkingFolder folder;
    write_study(folder, experiment, "15", 100'000);
    Outcome stopped;
    const double seconds = seconds_of(folder, "run s.toml -o a.h5 --threads 2 --time-limit 1s", stopped);
    INFO(experiment << ": " << seconds << " s, " << stopped.error);
    CHECK(stopped.exit_code == 4);
    CHECK(seconds < 8.0);
    // What was finished is kept: of blocks of one trial nearly all that time allows, of the others nothing.
    std::smatch kept;
    REQUIRE(std::regex_search(stopped.error, kept, std::regex("stopped; ([0-9]+) of")));
    if (std::string(experiment) == "nap") CHECK(std::stoi(kept[1]) > 10);
  }
}

TEST_CASE("a pilot of long trials runs as few as it needs, and says what they take") {
  const WorkingFolder folder;
  for (const char* experiment : {"nap", "sleep"}) {
    write_study(folder, experiment, "400, 500, 600", 1'000);
    Outcome plan;
    CHECK(seconds_of(folder, "plan s.toml --threads 2", plan) < 20.0);
    std::smatch pilot;
    INFO(plan.out << plan.error);
    REQUIRE(std::regex_search(plan.out, pilot, std::regex("pilot +([0-9]+) ms per trial")));
    CHECK(std::stod(pilot[1]) > 390.0);
    CHECK(std::stod(pilot[1]) < 900.0);
  }
}

TEST_CASE("what a plan says of time counts no thread that has no block") {
  const WorkingFolder folder;
  write_study(folder, "sleep", "1", 4096);
  const Outcome plan = call(folder, "plan s.toml --threads 64");
  CHECK(contains(plan.out, "on 64 threads, 1 of them at work"));
}
