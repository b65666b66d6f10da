#include "studies/plan/cell_choice.hpp"

#include <string>

#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

struct Planned {
  Study study;
  Plan plan;

  explicit Planned(const std::string& sweep)
      : study(read_study({"demo", "demo.toml",
                          "experiment = \"ranging\"\n" + sweep +
                              "\n[[method]]\nsolver = \"irls\"\n[[method]]\nsolver = \"rrr\"\n"})),
        plan(make_plan(study)) {}

  std::size_t operator()(const std::string& text) const { return choose_cell(plan, text).index; }
  std::string refusal(const std::string& text) const {
    return tests::refusal_of([&] { choose_cell(plan, text); });
  }
};

const char* sweep = R"([sweep]
points = [3, 5]
depth_m = [[1, 5], [1, 10]]
range_sigma_m = [0.1, 0.3]
weight = ["huber", "tukey"]
)";

}  // namespace

TEST_CASE("a cell is named by its number or by its values") {
  const Planned cell(sweep);
  REQUIRE(cell.plan.cells.size() == 16);
  CHECK(cell("0") == 0);
  CHECK(cell("15") == 15);
  CHECK(cell("points=5,range_sigma_m=0.1,depth_m=[1,10],weight=tukey") == 13);
  CHECK(cell(" weight = \"tukey\", depth_m = [1.0, 1e1], range_sigma_m = 0.10, points = 5.0 ") == 13);
  CHECK(Planned("")("") == 0);
}

TEST_CASE("values need not be given where they leave one cell") {
  const Planned zipped("[sweep]\npoints = [3, 5]\nrange_sigma_m = [0.1, 0.3]\nzip = [[\"points\", \"range_sigma_m\"]]");
  CHECK(zipped("range_sigma_m=0.3") == 1);
  const Planned excluding(
      "[sweep]\npoints = [3, 5]\nrange_sigma_m = [0.1, 0.3]\nexclude = [{ points = 5, range_sigma_m = 0.3 }]");
  CHECK(excluding("points=5") == 2);
  CHECK(excluding.refusal("points=5,range_sigma_m=0.3") ==
        "--cell points=5,range_sigma_m=0.3: no cell of the sweep has all of these values");
}

TEST_CASE("what is not a cell is refused with what there is") {
  const Planned cell(sweep);
  CHECK(cell.refusal("16") == "--cell 16: there is no such cell (allowed: 0 to 15)");
  CHECK(cell.refusal("") ==
        "the sweep has 16 cells; choose one with --cell points=...,depth_m=...,range_sigma_m=...,weight=...");
  CHECK(cell.refusal("points=5,depth_m=[1,5],weight=huber") ==
        "--cell points=5,depth_m=[1,5],weight=huber: 2 cells of the sweep are like this; add range_sigma_m=...");
  CHECK(cell.refusal("point=5") ==
        "--cell point=5: \"point\" is no axis of the sweep, did you mean \"points\"? (swept are: points, "
        "depth_m, range_sigma_m, weight)");
  CHECK(cell.refusal("points=4") == "--cell points=4: points = 4 is not in the sweep (allowed: 3, 5)");
  CHECK(cell.refusal("depth_m=[1,6]") ==
        "--cell depth_m=[1,6]: depth_m = [1,6] is not in the sweep (allowed: [1.0, 5.0], [1.0, 10.0])");
  CHECK(cell.refusal("weight=tuky") ==
        "--cell weight=tuky: weight = tuky is not in the sweep, did you mean \"tukey\"? (allowed: huber, tukey)");
  CHECK(cell.refusal("points").find("neither the number of a cell nor AXIS=VALUE") != std::string::npos);
  CHECK(Planned("").refusal("points=5").find("the study sweeps nothing") != std::string::npos);
  for (const char* text :
       {"-1", ",", "=", "points=", "=5", "points=5,", "points=[", "depth_m=[1", "points=nan", "1e3"}) {
    INFO(text);
    CHECK_FALSE(cell.refusal(text).empty());
  }
}
