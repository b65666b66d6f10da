#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

namespace {

/// A folder with a small study and its result.
struct WithResult : WorkingFolder {
  WithResult() {
    write("study.toml", R"(title = "A small study"
experiment = "ranging"
trials = 40
[sweep]
points = [3, 5]
range_sigma_m = [0.1, 0.3]
[[method]]
solver = "rrr"
[[method]]
name = "damped"
solver = "lm"
)");
    REQUIRE(ridgeloc("run study.toml -o result.h5").exit_code == 0);
  }
};

}  // namespace

TEST_CASE("replay tells a trial of a result, of every method or those chosen") {
  const WithResult folder;
  const std::string before = folder.read("result.h5");
  const auto all = folder.ridgeloc("replay result.h5 --cell points=5,range_sigma_m=0.3 --trial 17");
  REQUIRE(all.exit_code == 0);
  CHECK(all.out.starts_with("A small study: points = 5, range_sigma_m = 0.3, trial 17\n"));
  for (const char* piece : {"objects\n", "truth", "rrr, iterations", "damped, outcome", "damped, ceres"}) {
    INFO(piece);
    CHECK(contains(all.out, piece));
  }
  CHECK(folder.ridgeloc("replay result.h5 --cell 3 --trial 17").out == all.out);
  CHECK(folder.read("result.h5") == before);
  CHECK(folder.entries() == std::vector<std::string>{"result.h5", "study.toml"});

  const auto chosen = folder.ridgeloc("replay result.h5 --cell 3 --trial 17 --method damped --solver lm --solver ols");
  REQUIRE(chosen.exit_code == 0);
  CHECK_FALSE(contains(chosen.out, "rrr"));
  CHECK(contains(chosen.out, "lm, iterations"));
  CHECK(contains(chosen.out, "ols, iterations"));
  CHECK(contains(folder.ridgeloc("replay result.h5 --cell 3 --trial 17 --solver rrr").out,
                 "rrr, settings shared, iterations"));
}

TEST_CASE("replay takes a study instead, and trials beyond those of the result") {
  const WithResult folder;
  const auto of_study = folder.ridgeloc("replay study.toml --cell 3 --trial 17");
  CHECK(of_study.exit_code == 0);
  CHECK(of_study.out == folder.ridgeloc("replay result.h5 --cell 3 --trial 17").out);
  CHECK(folder.ridgeloc("replay fig3a --cell 3 --trial 999999999999").exit_code == 0);
  CHECK(folder.ridgeloc("replay result.h5 --cell 3 --trial 40").exit_code == 0);
}

TEST_CASE("replay computes with the instruction set of the result") {
  const WithResult folder;
  REQUIRE(folder.ridgeloc("run study.toml -o baseline.h5 --isa baseline").exit_code == 0);
  CHECK(contains(folder.ridgeloc("replay baseline.h5 --cell 3 --trial 17").out, "\n  baseline  "));
}

TEST_CASE("replay writes JSON that other programs read") {
  const WithResult folder;
  const auto outcome = folder.ridgeloc("replay result.h5 --cell 3 --trial 17 --json");
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.out.starts_with("{\n  \"title\": \"A small study\",\n  \"experiment\": \"ranging\""));
  CHECK(contains(outcome.out, "\"cell\": {\"points\": 5, \"range_sigma_m\": 0.3},\n  \"trial\": 17,"));
  CHECK(contains(outcome.out, "\"iterations\": [\n        {\"iteration\": 0, \"x_m\": "));
  CHECK(outcome.out.ends_with("]\n}\n"));
  CHECK_FALSE(contains(outcome.out, "nan"));
}

TEST_CASE("replay draws a picture") {
  const WithResult folder;
  for (const char* name : {"scene.svg", "scene.pdf", "scene.png"}) {
    const auto outcome = folder.ridgeloc(std::string("replay result.h5 --cell 3 --trial 17 -o ") + name);
    INFO(outcome.error);
    CHECK(outcome.exit_code == 0);
  }
  const std::string svg = folder.read("scene.svg");
  for (const char* piece : {"trial 17", "rrr: ", "damped: ", "Ceres from the start", "y [m], to the left"}) {
    INFO(piece);
    CHECK(contains(svg, piece));
  }
  CHECK(folder.read("scene.pdf").starts_with("%PDF"));
  CHECK(folder.read("scene.png").starts_with("\x89PNG"));
}

TEST_CASE("replay refuses what it cannot use with one line") {
  const WithResult folder;
  struct Case {
    const char* arguments;
    const char* message;
  };
  const Case cases[] = {
      {"result.h5 --cell 3", "--trial is required"},
      {"result.h5 --cell 3 --trial -1", "not in range 0 to 999999999999"},
      {"result.h5 --cell 3 --trial 1000000000000", "not in range 0 to 999999999999"},
      {"result.h5 --trial 1", "the sweep has 4 cells; choose one with --cell points=...,range_sigma_m=..."},
      {"result.h5 --trial 1 --cell 4", "allowed: 0 to 3"},
      {"result.h5 --trial 1 --cell point=5,range_sigma_m=0.3", "did you mean \"points\"?"},
      {"result.h5 --trial 1 --cell points=4,range_sigma_m=0.3", "points = 4 is not in the sweep (allowed: 3, 5)"},
      {"result.h5 --trial 1 --cell points=5", "add range_sigma_m=..."},
      {"result.h5 --trial 1 --cell 3 --method dampd", "did you mean \"damped\"? (allowed: rrr, damped)"},
      {"result.h5 --trial 1 --cell 3 --solver dogle", "did you mean \"dogleg\"?"},
      {"result.h5 --trial 1 --cell 3 -o picture.jpg", ".svg, .pdf or .png"},
      {"result.h5 --trial 1 --cell 3 -o nowhere/picture.svg", "nowhere"},
      {"nothing.h5 --trial 1", "nothing.h5"},
      {"nothing.toml --trial 1", "no such study file"},
      {"fig3 --trial 1", "did you mean \"fig3a\"?"},
  };
  for (const Case& bad : cases) {
    const auto outcome = folder.ridgeloc(std::string("replay ") + bad.arguments);
    INFO(bad.arguments << ": " << outcome.error);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.error.starts_with("ridgeloc: "));
    CHECK(outcome.error.find('\n') == outcome.error.size() - 1);
    CHECK(contains(outcome.error, bad.message));
  }
}
