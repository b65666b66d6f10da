// Maps of buildings in study files, in files of their own, by name and at random.

#include <fstream>

#include "sim/random_building.hpp"
#include "studies/files/map_reader.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/files/study_writer.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

const std::string valid_map = R"(name = "flat"
[[area]]
name = "corridor"
x_m = [0, 10]
y_m = [0, 2]
[[area]]
x_m = [4, 6]
y_m = [2, 8]
[[opening]]
name = "doorway"
x_m = [8, 9]
y_m = [2, 2.2]
[[wall]]
from_m = [3, 0]
to_m = [3, 1]
[[class]]
name = "door"
width_m = 0.9
height_m = 2.1
recall = [0.9, 0.25]
[[class]]
name = "bin"
width_m = 0.35
height_m = 0.6
[[object]]
name = "front door"
class = "door"
at_m = [0, 1, 1.05]
[[object]]
class = "bin"
at_m = [5, 7, 0.3]
height_m = 0.7
)";

/// A folder with `map.toml` and the path of a study beside it; removed at the end.
class MapFolder {
 public:
  explicit MapFolder(const std::string& map) { std::ofstream(folder_ / "map.toml") << map; }

  /// A study with that map, written as in its file.
  Study study(const std::string& value) const {
    return read_study({"demo", (folder_ / "study.toml").string(),
                       "experiment = \"building\"\n[building]\nmap = " + value + "\n[[method]]\nsolver = \"ols\"\n"});
  }

  /// The error message without the folder; empty if there is none.
  std::string error_of(const std::string& value) const {
    std::string text = tests::refusal_of([&] { study(value); });
    const std::string folder = folder_.path().string() + "/";
    for (auto at = text.find(folder); at != std::string::npos; at = text.find(folder)) text.erase(at, folder.size());
    return text;
  }

 private:
  tests::ScratchFolder folder_;
};

const std::string from_file = R"({ file = "map.toml" })";

const sim::BuildingMap& map_of(const Study& study) {
  return std::get<Building>(study.fixed.at("map")).map();
}

/// `valid_map` with one piece replaced.
std::string map_with(const std::string& piece, const std::string& replacement) {
  std::string text = valid_map;
  const auto at = text.find(piece);
  REQUIRE(at != std::string::npos);
  return text.replace(at, piece.size(), replacement);
}

}  // namespace

TEST_CASE("a map is read from a file beside the study") {
  const sim::BuildingMap map = map_of(MapFolder(valid_map).study(from_file));
  CHECK(map.name == "flat");
  REQUIRE(map.areas.size() == 2);
  CHECK(map.areas[0] == sim::Rectangle{"corridor", {0.0, 10.0}, {0.0, 2.0}});
  CHECK(map.areas[1].name.empty());
  CHECK(map.openings == std::vector<sim::Rectangle>{{"doorway", {8.0, 9.0}, {2.0, 2.2}}});
  CHECK(map.walls == std::vector<sim::Wall>{{{3.0, 0.0}, {3.0, 1.0}}});
  REQUIRE(map.classes.size() == 2);
  CHECK(map.classes[0] == sim::ObjectClass{"door", 0.9, 2.1, std::array<double, 2>{0.9, 0.25}});
  CHECK_FALSE(map.classes[1].recall);
  REQUIRE(map.objects.size() == 2);
  CHECK(map.objects[0] == sim::MapObject{"front door", 0, {0.0, 1.0, 1.05}, 0.9, 2.1});
  CHECK(map.objects[1] == sim::MapObject{"bin 2", 1, {5.0, 7.0, 0.3}, 0.35, 0.7});
}

TEST_CASE("a map written in full reads back equal, also through a resolved study") {
  const std::string value = GENERATE(as<std::string>(), from_file, "{ random = 7, wings = 2, objects = 30 }");
  const MapFolder folder(valid_map);
  const Study study = folder.study(value);
  CHECK(map_of(folder.study(to_toml(study.fixed.at("map")))) == map_of(study));
  const std::string resolved = resolved_toml(study);
  const Study again = read_study({"demo", "elsewhere/demo.toml", resolved});
  CHECK(map_of(again) == map_of(study));
  CHECK(resolved_toml(again) == resolved);
}

TEST_CASE("maps with awkward names and numbers read back equal") {
  sim::BuildingMap map;
  map.name = "a \"floor\"\n\\ with = [brackets]";
  map.areas = {{"", {-1e5, 1.0 / 3.0}, {0.1 + 0.2, 1e5}}};
  map.classes = {{"\xC3\xA9\t", 0.001, 1000.0, {}}};
  map.objects = {{"#1", 0, {0.0, 1.0 / 7.0 + 1.0, -1e-7}, 1.0 / 3.0, 1e3}};
  const Study study = MapFolder(valid_map).study(to_toml(Building(map)));
  CHECK(map_of(study) == map);
}

TEST_CASE("a map that comes with the program is found by name and written as such") {
  const Study study = MapFolder(valid_map).study("\"paper\"");
  const Building* paper = find_building("paper");
  REQUIRE(paper != nullptr);
  CHECK(map_of(study) == paper->map());
  CHECK(to_toml(study.fixed.at("map")) == "\"paper\"");
  CHECK(resolved_toml(study).find("map = \"paper\"\n") != std::string::npos);
  CHECK(find_building("nowhere") == nullptr);
  REQUIRE(paper->map().areas.size() == 3);
  CHECK(paper->map().areas[0].area_m2() == Approx(52.0 * 2.4));
  CHECK(paper->map().areas[1].area_m2() == Approx(33.0 * 2.4));
  CHECK(paper->map().areas[2].area_m2() == Approx(49.0));
}

TEST_CASE("a random map is the one of its options") {
  const MapFolder folder(valid_map);
  CHECK(map_of(folder.study("{ random = 9 }")) == sim::random_building({.seed = 9}));
  CHECK(map_of(folder.study("{ random = 9, wings = 3, objects = 12 }")) ==
        sim::random_building({.seed = 9, .wings = 3, .objects = 12}));
}

TEST_CASE("what is wrong with a map file is said in one line with its place") {
  const auto [text, message] = GENERATE(table<std::string, std::string>({
      {map_with("x_m = [4, 6]\ny_m = [2, 8]", "x_m = [4, 6]\ny_m = [1.9, 8]"),
       "map.toml:6: area 2 overlaps area \"corridor\"; let areas touch along a border instead"},
      {map_with("y_m = [2, 8]", "y_m = [8, 2]"),
       "map.toml:8: area 2: y_m = [8, 2] is not allowed: the second must be larger than the first, by 0.001 at least"},
      {map_with("y_m = [2, 8]", "y_m = [2, 8, 9]"),
       "map.toml:8: area 2: y_m = [ 2, 8, 9 ] is not allowed: it takes a list of 2 numbers from -100000 to 100000"},
      {map_with("y_m = [2, 8]", "y_m = [2, nan]"), "map.toml:8: area 2: y_m = [ 2, nan ] is not allowed"},
      {map_with("y_m = [2, 8]", "y_m = [2, 2e5]"), "map.toml:8: area 2: y_m"},
      {map_with("y_m = [2, 8]", "y_m = 8"), "map.toml:8: area 2: y_m = 8 is not allowed"},
      {map_with("y_m = [2, 8]", "y = [2, 8]"), "map.toml:8: unknown key \"y\" in [[area]] (did you mean \"y_m\"?)"},
      {map_with("y_m = [2, 8]\n", ""), "map.toml:6: area 2 lacks y_m"},
      {map_with("to_m = [3, 1]", "to_m = [3, \"1\"]"), "map.toml:15: wall 1: to_m = [ 3, '1' ] is not allowed"},
      {map_with("to_m = [3, 1]", "to_m = [3, 0]"), "map.toml:13: wall 1 ends where it begins"},
      {map_with("width_m = 0.9", "width_m = 0"),
       "map.toml:18: class \"door\": width_m = 0 is not allowed: it takes a number from 0.001 to 1000"},
      {map_with("width_m = 0.9", "width_m = \"wide\""), "map.toml:18: class \"door\": width_m = 'wide' is not allowed"},
      {map_with("width_m = 0.9\n", ""), "map.toml:16: class \"door\" lacks width_m"},
      {map_with("recall = [0.9, 0.25]", "recall = [0.5, 1.25]"),
       "map.toml:20: class \"door\": recall = [ 0.5, 1.25 ] is not allowed: it takes a list of 2 numbers from 0 to 1"},
      {map_with("name = \"bin\"", "name = \"door\""), "map.toml:21: class \"door\" is there twice"},
      {map_with("class = \"door\"", "class = \"dor\""),
       "map.toml:27: object \"front door\": unknown class \"dor\" (did you mean \"door\"?)"},
      {map_with("at_m = [0, 1, 1.05]", "at_m = [-1, 1, 1.05]"),
       "map.toml:25: object \"front door\" at [-1, 1] lies outside of every area"},
      {map_with("at_m = [0, 1, 1.05]", "at_m = [8.5, 2.1, 1.05]"), "lies outside of every area"},
      {map_with("at_m = [0, 1, 1.05]", "at_m = [0, 1]"),
       "map.toml:28: object \"front door\": at_m = [ 0, 1 ] is not allowed"},
      {map_with("at_m = [5, 7, 0.3]", "at_m = [0.2, 1, 0.3]"), "map.toml:29: object 2 overlaps object \"front door\""},
      {map_with("[[object]]\nclass", "[[object]]\nname = \"front door\"\nclass"),
       "map.toml:29: object \"front door\" is there twice"},
      {map_with("name = \"front door\"", "name = \"bin 2\""), "map.toml:29: object \"bin 2\" is there twice"},
      {map_with("height_m = 0.7", "height_m = 1001"), "map.toml:32: object 2: height_m = 1001 is not allowed"},
      {map_with("height_m = 0.7", "hight_m = 0.7"),
       "map.toml:32: unknown key \"hight_m\" in [[object]] (did you mean \"height_m\"?)"},
      {map_with("[[wall]]", "[[wal]]"), "unknown key \"wal\" in a map (did you mean \"wall\"?)"},
      {map_with("name = \"flat\"", "name = 3"), "map.toml:1: name"},
      {map_with("[[class]]\nname = \"door\"", "[[class]]\n"), "map.toml:16: class 1 lacks name"},
      {valid_map.substr(0, valid_map.find("[[object]]")),
       "map.toml:1: the map has no [[object]]; without objects no photo shows anything"},
      {valid_map.substr(valid_map.find("[[class]]")),
       "map.toml:1: the map has no [[area]]; give at least one corridor or room"},
      {map_with("x_m = [0, 10]", "x_m = [0, 10"), "map.toml:5: not valid TOML: "},
  }));
  const std::string error = MapFolder(text).error_of(from_file);
  INFO(message << "\n" << error);
  CHECK(error.find(message) != std::string::npos);
  CHECK(error.starts_with("map.toml:"));
  CHECK(error.find('\n') == std::string::npos);
}

TEST_CASE("a map of too many parts is refused") {
  std::string text = valid_map;
  for (int i = 0; i < 1000; ++i)
    text += "[[class]]\nname = \"c" + std::to_string(i) + "\"\nwidth_m = 1\nheight_m = 1\n";
  CHECK(MapFolder(text).error_of(from_file).find("the map has 1002 [[class]]; at most 1000 are allowed") !=
        std::string::npos);
}

TEST_CASE("what is wrong with the choice of a map is said in one line with its place") {
  const MapFolder folder(valid_map);
  const auto [value, message] = GENERATE(table<std::string, std::string>({
      {"\"papre\"",
       "map: there is no map \"papre\" (did you mean \"paper\"?); for a file write { file = \"NAME.toml\" }"},
      {"3", "map = 3 is not allowed: "},
      {"{ file = \"nowhere.toml\" }", "map.file: there is no file nowhere.toml"},
      {"{ file = 3 }", "map.file"},
      {"{ file = \"map.toml\", wings = 2 }", "unknown key \"wings\""},
      {"{ random = -1 }", "map.random = -1 is not allowed: it takes a whole number from 0 to "},
      {"{ random = 1.5 }", "map.random = 1.5 is not allowed"},
      {"{ random = 1, wings = 0 }", "map.wings = 0 is not allowed: it takes a whole number from 1 to 1000"},
      {"{ random = 1, objects = 201 }", "map.objects = 201 is not allowed: it takes a whole number from 1 to 200"},
      {"{ random = 1, wing = 2 }", "unknown key \"wing\""},
      {"{ name = \"here\" }", "the map has no [[area]]"},
  }));
  const std::string error = folder.error_of(value);
  INFO(error);
  CHECK(error.starts_with("study.toml:3: "));
  CHECK(error.find(message) != std::string::npos);
  CHECK(error.find('\n') == std::string::npos);
}
