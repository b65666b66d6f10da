#include "studies/plan/plan.hpp"

#include <set>

#include "studies/files/study_reader.hpp"
#include "studies/plan/assignment.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

Study swept_study(const std::string& sweep, const std::vector<std::string>& overrides = {}) {
  return read_study({"demo", "demo.toml",
                     "experiment = \"ranging\"\ntrials = 10000\n[sweep]\n" + sweep +
                         "\n[[method]]\nsolver = \"rrr\"\n[[method]]\nsolver = \"ols\"\n"},
                    overrides);
}

Plan plan(const std::string& sweep, const std::vector<std::string>& overrides = {}) {
  return make_plan(swept_study(sweep, overrides));
}

}  // namespace

TEST_CASE("axes are crossed, the last one fastest") {
  const Plan p = plan("points = [3, 5]\nrange_sigma_m = { from = 0.1, to = 0.3, step = 0.1 }");
  REQUIRE(p.cells.size() == 6);
  CHECK(p.cells[1].indices == std::vector<std::size_t>{0, 1});
  CHECK(std::get<std::int64_t>(p.cells[3].values.at("points")) == 5);
  CHECK(std::get<double>(p.cells[2].values.at("range_sigma_m")) == 0.3);
  std::set<std::string> hashes;
  for (const results::CellInfo& cell : p.header.cells) hashes.insert(cell.hash);
  CHECK(hashes.size() == 6);
}

TEST_CASE("zipped axes move together and excluded cells are left out") {
  const Plan p = plan(
      "points = [3, 5, 7]\nrange_sigma_m = [0.1, 0.2, 0.3]\nstart_offset_m = [1, 5]\n"
      "zip = [[\"points\", \"range_sigma_m\"]]\nexclude = [{ points = 5, start_offset_m = 1.0 }]");
  REQUIRE(p.cells.size() == 5);
  for (std::size_t i = 0; i < p.cells.size(); ++i) {
    const Cell cell = p.cells[i];
    CHECK(cell.index == i);
    CHECK(cell.indices == p.header.cells[i].indices);
    CHECK(cell.indices[0] == cell.indices[2]);
    CHECK_FALSE((cell.values.at("points") == Value(std::int64_t{5}) && cell.values.at("start_offset_m") == Value(1.0)));
  }
}

TEST_CASE("each cell of a grid has what it has alone, also where cells are left out") {
  const std::string axes = "points = [3, 5]\nrange_sigma_m = [0.1, 0.2, 0.3]\n";
  for (const char* exclude : {"", "exclude = [{ points = 3, range_sigma_m = 0.2 }, { range_sigma_m = 0.3 }]"}) {
    const CellGrid grid(swept_study(axes + exclude));
    Cell moved = grid[grid.size() - 1];
    for (std::size_t i = 0; i < grid.size(); ++i) {
      grid.move_to(i, moved);
      CHECK(moved.index == i);
      CHECK(moved.indices == grid[i].indices);
      CHECK(moved.values == grid[i].values);
    }
    CHECK(grid.size() == (*exclude == 0 ? 6U : 3U));
    CHECK(grid.has_any({{"points", std::int64_t{3}}, {"range_sigma_m", 0.2}}) == (*exclude == 0));
    CHECK(grid.has_any({{"points", std::int64_t{3}}, {"range_sigma_m", 0.1}}));
    CHECK_FALSE(grid.has_any({{"points", std::int64_t{4}}}));
  }
  CHECK(CellGrid(swept_study(axes + "exclude = [{ points = 3 }, { points = 5 }]")).empty());
}

TEST_CASE("a study of more totals than can be held is refused") {
  std::string methods;
  for (int i = 0; i < 30; ++i) methods += "[[method]]\nsolver = \"lm\"\nname = \"m" + std::to_string(i) + "\"\n";
  const std::string axes =
      "[sweep]\npoints = { from = 3, to = 1000, step = 1 }\nrange_sigma_m = { from = 0.001, to = 1, step = 0.001 }\n";
  const auto message = tests::refusal_of([&] {
    make_plan(read_study({"demo", "demo.toml", "experiment = \"ranging\"\n" + axes + methods}));
  });
  CHECK(
      tests::lacking(message, {"demo: 998000 cells with 60 methods and comparisons each; their product may be 20000000",
                               "cut the study in pieces"}) == "");
}

TEST_CASE("zipped axes may repeat values, which stand once on the axis of the result") {
  const Plan p =
      plan("points = [3, 3, 7, 7]\nrange_sigma_m = [0.1, 0.2, 0.2, 0.3]\nzip = [[\"points\", \"range_sigma_m\"]]");
  REQUIRE(p.cells.size() == 4);
  CHECK(p.header.axes[0].values.size() == 2);
  CHECK(p.header.axes[1].values.size() == 3);
  CHECK(p.header.cells[2].indices == std::vector<std::size_t>{1, 1});
  CHECK(std::get<double>(p.cells[2].values.at("range_sigma_m")) == 0.2);
  CHECK(std::get<std::int64_t>(p.header.axes[0].values[1]) == 7);
  // That of the lines "points = 7" and "range_sigma_m = 0.2", wherever they stand.
  CHECK(p.header.cells[2].hash == "64a6175da92f500c");
}

TEST_CASE("exclude leaves out all rows of zipped axes that have a repeated value") {
  const std::string axes =
      "points = [3, 3, 7, 7]\nrange_sigma_m = [0.1, 0.2, 0.2, 0.3]\nstart_offset_m = [1, 5]\n"
      "zip = [[\"points\", \"range_sigma_m\"]]\n";
  const Plan by_one = plan(axes + "exclude = [{ points = 7 }]");
  REQUIRE(by_one.cells.size() == 4);
  for (const results::CellInfo& cell : by_one.header.cells) CHECK(cell.indices[0] == 0);
  CHECK(by_one.cells.has_any({{"points", std::int64_t{3}}, {"range_sigma_m", 0.2}}));
  CHECK_FALSE(by_one.cells.has_any({{"points", std::int64_t{7}}}));
  CHECK_FALSE(by_one.cells.has_any({{"range_sigma_m", 0.3}}));

  const Plan by_two = plan(axes + "exclude = [{ points = 7, range_sigma_m = 0.2 }]");
  CHECK(by_two.cells.size() == 6);
  CHECK(by_two.cells.has_any({{"points", std::int64_t{7}}}));
  CHECK(by_two.cells.has_any({{"range_sigma_m", 0.2}}));
  CHECK_FALSE(by_two.cells.has_any({{"points", std::int64_t{7}}, {"range_sigma_m", 0.2}}));
}

TEST_CASE("blocks cover the trials of a cell, the last one in part") {
  const Assignment all = everything(plan("points = [3]"));
  CHECK(all.blocks_per_cell() == 3);
  CHECK(all.range(0).count == 4096);
  CHECK(all.range(2).first == 8192);
  CHECK(all.range(2).count == 10000 - 8192);
}

TEST_CASE("as many trials of each cell are kept as fit into the size for all, whatever the trials of the study") {
  for (const char* sweep : {"points = [3]", "points = [3, 4, 5, 6]"}) {
    for (const char* trials : {"trials=10", "trials=1000000"}) {
      const Study s = swept_study(sweep, {trials, "store.trial_columns_mib=1"});
      const Plan p = make_plan(s);
      const std::uint64_t all = p.cells.size() * bytes_per_trial(s);
      CHECK(p.header.kept_trials * all <= 1 << 20);
      CHECK((p.header.kept_trials + 1) * all > 1 << 20);
    }
  }
  CHECK(plan("points = [3]", {"store.trial_columns_mib=0"}).header.kept_trials == 0);
}

TEST_CASE("the study hash changes with what changes every number, and with nothing else") {
  const std::string sweep = "points = [3, 5]";
  const auto hash = [&](const std::vector<std::string>& overrides) { return plan(sweep, overrides).header.study_hash; };
  const std::string before = hash({});
  for (const char* same : {"trials=99", "title=x", "sweep.points=[7]", "store.trial_columns_mib=1",
                           "method.0.theta_m=1", "solver.max_iterations=50", "method.1.name=other"}) {
    INFO(same);
    CHECK(hash({same}) == before);
  }
  for (const char* different : {"seed=1", "scene.depth_m=[1,9]", "noise.range_sigma_m=0.2", "scene.start_offset_m=4"}) {
    INFO(different);
    CHECK(hash({different}) != before);
  }
}

TEST_CASE("cells know what their bounds are good for") {
  const auto kinds = [](const std::string& sweep, const std::vector<std::string>& overrides = {}) {
    std::string text;
    for (const results::CellInfo& cell : plan(sweep, overrides).header.cells)
      text += std::to_string(static_cast<int>(cell.bound));
    return text;
  };
  static_assert(static_cast<int>(results::BoundKind::RootMeanSquare) == 2);
  CHECK(kinds("points = [3, 4, 5, 6]") == "1122");
  CHECK(kinds("points = [3, 4, 5, 6]", {"scene.model=pseudorange"}) == "1112");
  CHECK(kinds("points = [3, 4, 5, 6]", {"scene.model=pseudorange", "scene.z_mode=fixed"}) == "1122");
  CHECK(kinds("points = [3, 4, 5]\nv_mode = [\"fixed\", \"prior\"]", {"scene.model=pseudorange"}) == "111122");
  CHECK(kinds("points = [3, 4]", {"scene.z_mode=fixed"}) == "12");
  CHECK(kinds("noise_model = [\"normal\", \"student_t\"]") == "20");
  CHECK(kinds("scores = [\"none\", \"random\"]") == "20");
}

TEST_CASE("a cell's hash is that of its values, wherever it stands in the grid") {
  const Plan narrow = plan("points = [5]\nrange_sigma_m = [0.3]");
  const Plan wide = plan("points = [3, 5]\nrange_sigma_m = [0.1, 0.3, 0.5]");
  CHECK(narrow.header.cells[0].hash == wide.header.cells[4].hash);
}

TEST_CASE("a method's hash is that of the settings its solver reads") {
  const std::string sweep = "points = [3]";
  const auto hashes = [&](const std::vector<std::string>& overrides) {
    const Plan p = plan(sweep, overrides);
    return std::vector<std::string>{p.header.methods[0].hash, p.header.methods[1].hash};
  };
  const auto before = hashes({});
  CHECK(hashes({"method.0.theta_m=1"})[0] != before[0]);
  CHECK(hashes({"solver.theta_m=1"})[0] == hashes({"method.0.theta_m=1"})[0]);
  CHECK(hashes({"solver.theta_m=1"})[1] == before[1]);
  CHECK(hashes({"method.0.name=x"}) == before);
}
