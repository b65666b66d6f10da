#include <algorithm>
#include <regex>

#include "results/store/result_file.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

const std::string small = R"(experiment = "ranging"
trials = 50
[sweep]
points = [3, 5]
[[method]]
solver = "rrr"
[[method]]
solver = "ols"
[[figure]]
x = "points"
y = "error_all_m"
group = "method"
)";

}  // namespace

TEST_CASE("run writes one result, prints its path, and does nothing the second time") {
  const WorkingFolder folder;
  folder.write("small.toml", small);
  const Outcome first = folder.ridgeloc("run small.toml");
  CHECK(first.exit_code == 0);
  CHECK(first.out == "small.h5\n");
  CHECK(folder.entries() == std::vector<std::string>{"small.h5", "small.toml"});
  const Outcome second = folder.ridgeloc("run small.toml");
  CHECK(second.exit_code == 0);
  CHECK(second.error.find("complete already") != std::string::npos);
}

TEST_CASE("a result of another study is never overwritten") {
  const WorkingFolder folder;
  folder.write("small.toml", small);
  REQUIRE(folder.ridgeloc("run small.toml").exit_code == 0);
  const std::string before = folder.read("small.h5");
  for (const char* change : {"--audit 0.5", "--seed 3", "--set noise.range_sigma_m=0.2"}) {
    const Outcome outcome = folder.ridgeloc(std::string("run small.toml ") + change);
    CHECK(outcome.exit_code == 2);
    CHECK(line_count(outcome.error) == 1);
    CHECK(outcome.error.find("small.h5: holds another study (") != std::string::npos);
  }
  CHECK(folder.read("small.h5") == before);
}

TEST_CASE("samples of noise come from a file beside the study and stay in the result") {
  const WorkingFolder folder;
  REQUIRE(folder.shell("mkdir data").exit_code == 0);
  folder.write("data/residuals.csv", "id,e_m\n1,0.5\n2,-1.5\n3,0.25\n");
  folder.write("data/field.toml", R"(experiment = "ranging"
trials = 50
[noise]
noise_model = "empirical"
noise_samples = { file = "residuals.csv", column = "e_m" }
[[method]]
solver = "ols"
)");
  REQUIRE(folder.ridgeloc("run data/field.toml -o field.h5").exit_code == 0);
  const std::string resolved = results::read_result_header(folder.path() / "field.h5").study_toml;
  CHECK(resolved.find("noise_samples = [0.5, -1.5, 0.25]\n") != std::string::npos);

  // The file has done its work: the study in the result is the same study.
  folder.write("again.toml", resolved);
  const Outcome again = folder.ridgeloc("run again.toml -o field.h5");
  CHECK(again.exit_code == 0);
  CHECK(again.error.find("complete already") != std::string::npos);

  folder.write("data/residuals.csv", "id,e_m\n1,0.5\n2,?\n");
  const Outcome bad = folder.ridgeloc("run data/field.toml -o other.h5");
  CHECK(bad.exit_code == 2);
  CHECK(bad.error == "ridgeloc: data/residuals.csv:3: \"?\" in column \"e_m\" is not a number\n");
}

TEST_CASE("a study may be called anything, and its figures can be drawn") {
  const WorkingFolder folder;
  for (const std::string name : {"my study", "study (1)", "größe", "a+b", ".hidden"}) {
    INFO(name);
    REQUIRE(folder.ridgeloc("new ranging -o '" + name + ".toml'").exit_code == 0);
    const Outcome run = folder.ridgeloc("run '" + name + ".toml' --trials 10 --audit 0 --threads 1");
    INFO(run.error);
    CHECK(run.exit_code == 0);
    const Outcome plot = folder.ridgeloc("plot '" + name + ".h5'");
    REQUIRE(plot.exit_code == 0);
    CHECK(folder.has(plot.out.substr(0, plot.out.size() - 1)));
  }
}

TEST_CASE("a study comes from a pipe as from a file") {
  const WorkingFolder folder;
  folder.write("s.toml", "title = \"t\"\nexperiment = \"ranging\"\ntrials = 10\n[[method]]\nsolver = \"lm\"\n");
  const std::string program = "'" RIDGELOC_PROGRAM "'";
  REQUIRE(folder.ridgeloc("run s.toml -o file.h5").exit_code == 0);
  const Outcome piped = folder.shell("cat s.toml | " + program + " run /dev/stdin -o pipe.h5");
  INFO(piped.error);
  REQUIRE(piped.exit_code == 0);
  CHECK(folder.ridgeloc("verify --digest pipe.h5").out == folder.ridgeloc("verify --digest file.h5").out);
  CHECK(folder.shell("cat s.toml | " + program + " plan /dev/stdin").exit_code == 0);
  CHECK(folder.shell("cat s.toml | " + program + " replay /dev/stdin --trial 3").exit_code == 0);
  const Outcome result = folder.shell("cat file.h5 | " + program + " run /dev/stdin -o other.h5");
  CHECK(result.exit_code == 2);
  CHECK(line_count(result.error) == 1);
  CHECK(folder.ridgeloc("run . -o other.h5").exit_code == 2);
}

TEST_CASE("several studies go to a folder, which is made") {
  const WorkingFolder folder;
  folder.write("a.toml", small);
  folder.write("b.toml", small);
  const Outcome outcome = folder.ridgeloc("run a.toml b.toml -o out");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == "out/a.h5\nout/b.h5\n");
  CHECK(folder.has("out/b.h5"));
  CHECK(folder.ridgeloc("run a.toml ./a.toml -o other").exit_code == 2);
  CHECK_FALSE(folder.has("other"));
}

TEST_CASE("threads change nothing in the data; trials, seed and settings do") {
  const WorkingFolder folder;
  folder.write("small.toml", small);
  const auto digest = [&](const std::string& options) {
    REQUIRE(folder.ridgeloc("run small.toml -o x.h5 " + options).exit_code == 0);
    const std::string value = results::data_digest(folder.path() / "x.h5");
    REQUIRE(folder.shell("rm x.h5").exit_code == 0);
    return value;
  };
  const std::string one = digest("--trials 9000 --threads 1");
  CHECK(digest("--trials 9e3 --threads 2") == one);
  CHECK(digest("--trials 9000 --threads 5") == one);
  CHECK(digest("--trials 9000 --seed 1") != one);
  CHECK(digest("--trials 9000 --set scene.depth_m=[2,15]") != one);
}

TEST_CASE("bad input is one line on standard error, exit code 2, and no file") {
  const WorkingFolder folder;
  folder.write("small.toml", small);
  folder.write("broken.toml", "[");
  folder.write("typo.toml", "experiment = \"ranging\"\n[scene]\npionts = 3\n[[method]]\nsolver = \"rr\"\n");
  folder.write("empty.toml", "experiment = \"ranging\"\n[sweep]\npoints = []\n[[method]]\nsolver = \"rr\"\n");
  folder.write("type.toml", "experiment = \"ranging\"\ntrials = \"ten\"\n[[method]]\nsolver = \"rr\"\n");
  folder.write("range.toml", "experiment = \"ranging\"\n[scene]\npoints = 2\n[[method]]\nsolver = \"rr\"\n");
  folder.write("not_a_folder", "");
  folder.write("stop.toml", small + "[stop]\nmetric = \"error_m\"\ntarget = 1\nmin_trials = 4096\nmax_trials = 8192\n");
  folder.write("result.h5", "\x89HDF\r\n\x1a\n and more");
  const auto before = folder.entries();
  const auto [arguments, message] = GENERATE(table<std::string, std::string>({
      {"run broken.toml", "broken.toml:1: not valid TOML"},
      {"run typo.toml", "typo.toml:3: unknown key \"pionts\" in [scene] (did you mean \"points\"?)"},
      {"run empty.toml", "empty.toml:3: sweep.points is an empty list"},
      {"run type.toml", "type.toml:2: trials = 'ten' is not allowed"},
      {"run range.toml",
       "range.toml:3: scene.points = 2 is not allowed: scene.points takes a whole number from 3 to 1000"},
      {"run missing.toml", "missing.toml: no such study file"},
      {"run fig3", "did you mean \"fig3a\"?"},
      {"run small.toml -o nowhere/x.h5", "nowhere"},
      {"run small.toml -o not_a_folder/x.h5", "not_a_folder"},
      {"run small.toml typo.toml -o out/", "typo.toml:3"},
      {"run small.toml --threads 0", "--threads"},
      {"run small.toml --trials none", "trials"},
      {"run small.toml --trials 0", "trials = 0 is not allowed"},
      {"run small.toml --set", "--set"},
      {"run small.toml --set scene.depth=1", "did you mean \"depth_m\"?"},
      {"run stop.toml --trials 9000", "[stop] has its own min_trials"},
      {"run stop.toml --set stop.min_trials=9000", "stop.max_trials"},
      {"plan stop.toml --trials 9000", "[stop] has its own min_trials"},
      {"run result.h5", "takes the study out of a result"},
      {"run", "STUDY"},
      {"rnu", "unknown verb \"rnu\", did you mean \"run\"?"},
      {"", "subcommand"},
      {"list solver", "solver"},
      {"new rangin", "rangin"},
      {"summary missing.h5", "missing.h5"},
      {"summary small.toml", "small.toml"},
      {"export missing.h5", "missing.h5"},
      {"plot missing.h5", "missing.h5"},
      {"report missing.h5", "missing.h5"},
      {"report small.toml", "small.toml"},
      {"report", "RESULT"},
      {"plan missing.toml", "missing.toml"},
  }));
  INFO("ridgeloc " << arguments);
  const Outcome outcome = folder.ridgeloc(arguments);
  INFO(outcome.error);
  CHECK(outcome.exit_code == 2);
  CHECK(line_count(outcome.error) == 1);
  CHECK(outcome.error.find(message) != std::string::npos);
  CHECK(outcome.out.empty());
  CHECK(folder.entries() == before);
}

TEST_CASE("a run stopped by a signal says how to go on, and goes on to the same bytes") {
  const WorkingFolder folder;
  folder.write("small.toml", small);
  REQUIRE(folder.ridgeloc("run small.toml --trials 400000 -o whole.h5").exit_code == 0);
  const Outcome stopped = folder.shell("'" RIDGELOC_PROGRAM
                                       "' run small.toml --trials 400000 --threads 1 & "
                                       "pid=$!; while ! ls small.h5.parts 2>/dev/null; do :; done; "
                                       "kill -TERM $pid; wait $pid");
  REQUIRE(stopped.exit_code == 4);
  CHECK(stopped.error.find("The same command goes on from there") != std::string::npos);
  CHECK_FALSE(folder.has("small.h5"));
  CHECK(folder.ridgeloc("run small.toml --trials 400000").exit_code == 0);
  CHECK(results::data_digest(folder.path() / "small.h5") == results::data_digest(folder.path() / "whole.h5"));
  CHECK_FALSE(folder.has("small.h5.parts"));
}

TEST_CASE("a run goes on with the instruction set that it began with, and refuses another one") {
  const WorkingFolder folder;
  folder.write("small.toml", small);
  const Outcome stopped = folder.shell("'" RIDGELOC_PROGRAM
                                       "' run small.toml --trials 4000000 --threads 1 --isa baseline & "
                                       "pid=$!; while ! ls small.h5.parts 2>/dev/null; do :; done; sleep 0.3; "
                                       "kill -TERM $pid; wait $pid");
  REQUIRE(stopped.exit_code == 4);
  REQUIRE(folder.has("small.h5.parts"));
  CHECK(folder.ridgeloc("run small.toml --trials 4000000 --isa sse9").exit_code == 2);
  CHECK(folder.ridgeloc("run small.toml --trials 4000000").exit_code == 0);
  CHECK(results::read_result_header(folder.path() / "small.h5").isa == "baseline");
  CHECK(folder.ridgeloc("run small.toml --trials 4000000").exit_code == 0);  // complete already
  const Outcome other = folder.ridgeloc("run small.toml --trials 4000000 --isa avx2");
  CHECK(other.exit_code == 2);
  CHECK(other.error.find("small.h5") != std::string::npos);
  CHECK(line_count(other.error) == 1);
}

TEST_CASE("a file-size limit, like a full disk, is one line, exit code 3, and keeps what is finished") {
  const WorkingFolder folder;
  folder.write("small.toml", small);
  // 64 blocks of 512 bytes: less than one part.
  const Outcome outcome =
      folder.shell("ulimit -f 64 && '" RIDGELOC_PROGRAM "' run small.toml --trials 50000 --threads 2");
  INFO(outcome.error);
  CHECK(outcome.exit_code == 3);
  CHECK(line_count(outcome.error) == 1);
  CHECK(outcome.error.find("the same command goes on from there") != std::string::npos);
  CHECK(outcome.error.find("finished parts are kept") == std::string::npos);  // there are none
  CHECK_FALSE(folder.has("small.h5.parts"));
  CHECK_FALSE(folder.has("small.h5"));
  CHECK(folder.ridgeloc("run small.toml --trials 50000").exit_code == 0);
}

TEST_CASE("a stop ends a run of a thousand billion trials at once") {
  const WorkingFolder folder;
  folder.write("small.toml", small);
  // timeout signals the program and its group, so that the program gets the signal twice.
  const Outcome outcome = folder.shell("timeout -s INT -k 20 1 '" RIDGELOC_PROGRAM "' run small.toml --trials 1e12");
  CHECK(outcome.exit_code == 124);  // timeout's own; 137 had it needed to kill
  CHECK(outcome.error.find("stopped;") != std::string::npos);
}

TEST_CASE("results in the way are found before anything is computed") {
  const WorkingFolder folder;
  folder.write("a.toml", small);
  folder.write("b.toml", small);
  REQUIRE(folder.ridgeloc("run b.toml --seed 5 -o out/").exit_code == 0);
  CHECK(folder.ridgeloc("run a.toml b.toml -o out").exit_code == 2);
  CHECK_FALSE(folder.has("out/a.h5"));
}

TEST_CASE("anchors come from a file, stay in the result, and what they leave open is said") {
  const WorkingFolder folder;
  folder.write("anchors.csv", "x_m,y_m,z_m\n0,0,2\n8,0,2\n8,6,2\n0,6,2\n");
  folder.write(
      "s.toml",
      "experiment = \"ranging\"\ntrials = 50\n[scene]\nobjects = \"given\"\nobjects_m = { file = \"anchors.csv\" }\n"
      "camera_x_m = [1, 7]\ncamera_y_m = [1, 5]\n[sweep]\nz_mode = [\"free\", \"fixed\"]\n"
      "[[method]]\nsolver = \"lm\"\n");
  const std::string remark = "note: all objects lie in one plane: every position has a mirror image";
  const Outcome run = folder.ridgeloc("run s.toml -o r.h5");
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(contains(run.error, "s: " + remark));
  CHECK(contains(folder.ridgeloc("plan s.toml").out, "note     all objects lie in one plane"));
  folder.shell("rm anchors.csv");
  CHECK(folder.ridgeloc("verify r.h5").exit_code == 0);
  CHECK(contains(folder.ridgeloc("export r.h5 --study").out, "objects_m = [[0.0, 0.0, 2.0], [8.0, 0.0, 2.0], "));
  const Outcome replay = folder.ridgeloc("replay r.h5 --cell z_mode=fixed --trial 3 -o t.svg");
  REQUIRE(replay.exit_code == 0);
  CHECK(std::regex_search(replay.out, std::regex(" 3 +8 +6 +2 ")));
  CHECK(contains(folder.read("t.svg"), "x [m]"));
  CHECK(folder.ridgeloc("run s.toml -o r.h5").exit_code == 2);  // the file is gone
  CHECK(folder.ridgeloc("export r.h5 --study").out.find("file") == std::string::npos);
}
