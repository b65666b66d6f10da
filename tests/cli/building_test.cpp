// Studies of photos by the program, with a map in a file of its own.

#include <algorithm>
#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

namespace {

const std::string map = R"(name = "hall"
[[area]]
name = "hall"
x_m = [0, 12]
y_m = [0, 8]
[[class]]
name = "door"
width_m = 0.9
height_m = 2.1
[[class]]
name = "bin"
width_m = 0.35
height_m = 0.6
[[object]]
class = "door"
at_m = [12, 1, 1.05]
[[object]]
class = "door"
at_m = [12, 6, 1.05]
[[object]]
class = "bin"
at_m = [11, 3, 0.3]
[[object]]
class = "bin"
at_m = [10, 5, 0.3]
[[object]]
class = "bin"
at_m = [10.5, 7, 0.3]
)";

const std::string study = R"(title = "A hall"
experiment = "building"
trials = 20
[building]
map = { file = "hall.toml" }
[photo]
detections = 3
[[method]]
solver = "ols"
[[method]]
solver = "rrr"
)";

struct WithMap : WorkingFolder {
  explicit WithMap(const std::string& text = map) {
    write("hall.toml", text);
    write("study.toml", study);
  }
};

}  // namespace

TEST_CASE("a study of photos runs with a map from a file, which the result keeps") {
  const WithMap folder;
  const Outcome run = folder.ridgeloc("run study.toml -o result.h5");
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  const Outcome summary = folder.ridgeloc("summary --all result.h5");
  CHECK(summary.exit_code == 0);
  for (const char* piece : {"success", "error_m", "objects_detected", "ols", "rrr"})
    CHECK(contains(summary.out, piece));

  const Outcome before = folder.ridgeloc("replay result.h5 --trial 3 -o photo.svg");
  REQUIRE(before.exit_code == 0);
  CHECK(before.out.starts_with("A hall: trial 3\n"));
  for (const char* piece : {"\ncamera\n", "\ndetections\n", "\nstarts\n", "\nols, outcome\n", "\nrrr, ends\n"}) {
    INFO(piece);
    CHECK(contains(before.out, piece));
  }
  const std::string svg = folder.read("photo.svg");
  for (const char* piece : {"ols: ", "rrr: ", "starts converge inside the map", "truth", "detected object"}) {
    INFO(piece);
    CHECK(contains(svg, piece));
  }
  // The map has done its work.
  REQUIRE(folder.shell("rm hall.toml").exit_code == 0);
  CHECK(folder.ridgeloc("replay result.h5 --trial 3").out == before.out);
}

TEST_CASE("a study of detections runs and is replayed") {
  const WithMap folder;
  folder.write("study.toml", R"(title = "Doors"
experiment = "detection"
trials = 20
[building]
map = { file = "hall.toml" }
[object]
object_class = "door"
)");
  REQUIRE(folder.ridgeloc("run study.toml -o result.h5").exit_code == 0);
  const Outcome replay = folder.ridgeloc("replay result.h5 --trial 3 -o photo.png");
  REQUIRE(replay.exit_code == 0);
  for (const char* piece : {"Doors: trial 3\n", "\ncamera\n", "\nobject\n", "door", "\noutcome\n"}) {
    INFO(piece);
    CHECK(contains(replay.out, piece));
  }
  CHECK(folder.read("photo.png").starts_with("\x89PNG"));
}

TEST_CASE("a bad map ends the program with one line that says where") {
  struct Case {
    const char* piece;
    const char* replacement;
    const char* message;
  };
  const Case cases[] = {
      {"class = \"bin\"", "class = \"bim\"",
       "ridgeloc: hall.toml:21: object 3: unknown class \"bim\" (did you mean \"bin\"?)\n"},
      {"[12, 6, 1.05]", "[13, 6, 1.05]", "ridgeloc: hall.toml:17: object 2 at [13, 6] lies outside of every area\n"},
      {"y_m = [0, 8]", "y_m = [0, 8", "ridgeloc: hall.toml:6: not valid TOML: "},
  };
  for (const Case& bad : cases) {
    std::string text = map;
    text.replace(text.find(bad.piece), std::string(bad.piece).size(), bad.replacement);
    const WithMap folder(text);
    const Outcome run = folder.ridgeloc("run study.toml -o result.h5");
    INFO(run.error);
    CHECK(run.exit_code == 2);
    CHECK(run.out.empty());
    CHECK(run.error.starts_with(bad.message));
    CHECK(std::ranges::count(run.error, '\n') == 1);
    CHECK_FALSE(folder.has("result.h5"));
  }
  const WithMap folder;
  REQUIRE(folder.shell("rm hall.toml").exit_code == 0);
  const Outcome run = folder.ridgeloc("run study.toml");
  CHECK(run.exit_code == 2);
  CHECK(run.error == "ridgeloc: study.toml:5: building.map.file: there is no file hall.toml\n");
}

TEST_CASE("what a map never shows ends the program with one line") {
  const WithMap folder;
  const Outcome run = folder.ridgeloc("run study.toml -o result.h5 --set photo.detections=9");
  INFO(run.error);
  CHECK(run.exit_code == 2);
  CHECK(contains(run.error, "photo.detections = 9: among 200000 photos of the map \"hall\" none has 9 detections"));
  CHECK(std::ranges::count(run.error, '\n') == 1);
}
