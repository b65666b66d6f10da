// Looking at a run that goes on, or was stopped.

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#include "results/store/result_file.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

const std::string study = R"(title = "A sweep that takes long enough to be looked at"
experiment = "ranging"
trials = 1000000000
audit = 0
[store]
trial_columns_mib = 0
[sweep]
points = [3, 5, 7]
range_sigma_m = [0.1, 0.3]
[[method]]
solver = "ols"
[[method]]
solver = "rrr"
[[figure]]
x = "points"
y = "error_m"
group = ["method", "range_sigma_m"]
)";

/// The number after a key of a JSON text.
std::uint64_t number_of(const std::string& json, const std::string& key) {
  const std::size_t place = json.find("\"" + key + "\": ");
  REQUIRE(place != std::string::npos);
  return std::stoull(json.substr(place + key.size() + 4));
}

std::size_t longest_line(const std::string& text) {
  std::istringstream in(text);
  std::size_t longest = 0;
  for (std::string line; std::getline(in, line);) longest = std::max(longest, line.size());
  return longest;
}

/// Sum of the populations of a metric over the rows of a CSV export.
std::uint64_t values_in(const std::string& csv, const std::string& metric) {
  std::istringstream in(csv);
  std::uint64_t sum = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.find("," + metric + ",") == std::string::npos) continue;
    std::istringstream cells(line);
    std::string cell;
    for (int c = 0; c < 6; ++c) std::getline(cells, cell, ',');
    sum += std::stoull(cell);
  }
  return sum;
}

}  // namespace

TEST_CASE("beside a run, status and export find no error, and what they count grows") {
  const WithStudy folder(study);
  const Outcome started =
      folder.shell("'" RIDGELOC_PROGRAM
                   "' run s.toml --threads 1 --time-limit 90s > run.out 2> run.err & echo $! > pid; "
                   "until ls s.h5.parts/run.txt > nothing 2>&1; do sleep 0.05; done");
  REQUIRE(started.exit_code == 0);
  std::uint64_t done = 0;
  std::uint64_t kept = 0;
  std::uint64_t values = 0;
  int grown = 0;
  const auto begin = std::chrono::steady_clock::now();
  // A part is written every five seconds.
  while (grown < 3 && std::chrono::steady_clock::now() - begin < std::chrono::seconds(60)) {
    const Outcome status = folder.ridgeloc("status --json s.h5");
    INFO(status.out << status.error);
    REQUIRE(status.exit_code == 0);
    REQUIRE(contains(status.out, "\"state\": \"running\""));
    REQUIRE(number_of(status.out, "blocks_done") >= done);
    REQUIRE(number_of(status.out, "blocks_kept") >= kept);
    done = number_of(status.out, "blocks_done");
    kept = number_of(status.out, "blocks_kept");
    REQUIRE(number_of(status.out, "blocks_total") == 6 * 244141);
    if (kept == 0) continue;
    const Outcome csv = folder.ridgeloc("export s.h5");
    REQUIRE(csv.exit_code == 0);
    REQUIRE(contains(csv.error, "s.h5: incomplete: the run has not come to its end; 6 of 6 cells"));
    const std::uint64_t now = values_in(csv.out, "iterations");
    REQUIRE(now >= values);
    if (now > values) ++grown;
    values = now;
  }
  CHECK(grown == 3);
  REQUIRE(folder.shell("kill -TERM $(cat pid); until grep -q stopped run.err; do sleep 0.05; done").exit_code == 0);
  const Outcome stopped = folder.ridgeloc("status s.h5.parts/");
  INFO(stopped.out);
  CHECK(stopped.exit_code == 0);
  CHECK(contains(stopped.out, "s.h5: stopped "));
  CHECK(contains(stopped.out, "cells    0 of 6 complete, 6 begun"));
  CHECK(contains(stopped.out, "at that rate about "));
  CHECK(contains(stopped.out, "  ols "));
  CHECK(longest_line(stopped.out) <= 100);
}

TEST_CASE("a stopped run can be read by every verb that shows totals, marked incomplete") {
  const WithStudy folder(study);
  REQUIRE(folder.ridgeloc("run s.toml --time-limit 1s").exit_code == 4);
  const std::string mark = "incomplete: the run has not come to its end";
  // A run that is told to stop at once has not counted yet what others left.
  REQUIRE(folder
              .shell("sed -i 's/^trials_done .*/trials_done 0/; s/^trials_found .*/trials_found 0/' "
                     "s.h5.parts/run.txt")
              .exit_code == 0);
  const Outcome looked = folder.ridgeloc("status --json s.h5");
  CHECK(number_of(looked.out, "blocks_kept") > 0);
  CHECK(number_of(looked.out, "trials_done") >= number_of(looked.out, "blocks_kept"));
  CHECK(contains(folder.ridgeloc("summary s.h5").out, mark));
  CHECK(contains(folder.ridgeloc("summary --all s.h5").out, mark));
  CHECK(contains(folder.ridgeloc("export --json s.h5").out, "\"sealed\": false"));
  CHECK(contains(folder.ridgeloc("export --latex s.h5").out, "seed 2018, incomplete."));
  CHECK(contains(folder.ridgeloc("export --failures s.h5").out, "\n"));
  CHECK(contains(folder.ridgeloc("export --against points=3 s.h5").out, "\n"));
  CHECK(contains(folder.ridgeloc("export --study s.h5").out, "trials = 1000000000"));
  const Outcome trials = folder.ridgeloc("export --trials s.h5");
  CHECK(trials.exit_code == 2);
  CHECK(contains(trials.error, "single trials are there to read when it has"));
  CHECK(folder.ridgeloc("plot s.h5").exit_code == 0);
  CHECK(contains(folder.read("error_m.svg") + folder.read("s.svg") + folder.read("figure1.svg"), mark));
  CHECK(folder.ridgeloc("report s.h5").exit_code == 0);
  CHECK(contains(folder.read("s.html"), mark));
  // What is of a sealed result alone is refused.
  for (const char* verb : {"verify", "merge -o m.h5", "audit", "replay --trial 0 --cell 0"})
    CHECK(folder.ridgeloc(std::string(verb) + " s.h5").exit_code == 2);
  // The same command seals what is there, and then nothing is marked.
  REQUIRE(folder.ridgeloc("run s.toml --trials 1").exit_code == 0);
  CHECK(contains(folder.ridgeloc("export --json s.h5").out, "\"sealed\": true"));
  const Outcome sealed = folder.ridgeloc("status s.h5");
  CHECK(contains(sealed.out, "s.h5: "));
  CHECK_FALSE(contains(sealed.out, "running"));
}

TEST_CASE("status of a killed run says so, of a complete result too, and of nothing is refused") {
  const WithStudy folder(study);
  REQUIRE(folder
              .shell("'" RIDGELOC_PROGRAM
                     "' run s.toml & run=$!; until ls s.h5.parts/part-*.h5 > nothing 2>&1; do sleep 0.1; done; "
                     "kill -KILL $run; touch -d '1 hour ago' s.h5.parts/run.txt")
              .exit_code == 0);
  CHECK(contains(folder.ridgeloc("status s.h5").out, "s.h5: silent for 1 h 0 min: killed, or its machine asleep"));
  REQUIRE(folder.ridgeloc("run s.toml -o done.h5 --trials 100").exit_code == 0);
  const Outcome both = folder.ridgeloc("status s.h5 done.h5");
  CHECK(contains(both.out, "\n\ndone.h5: complete\n"));
  CHECK(contains(both.out, "blocks   6 of 6 (100 %)\n"));
  const Outcome nothing = folder.ridgeloc("status nothing.h5");
  CHECK(nothing.exit_code == 2);
  CHECK(nothing.error == "ridgeloc: nothing.h5 does not exist; check the path\n");
}
