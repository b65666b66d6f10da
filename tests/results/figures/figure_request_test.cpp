#include "results/figures/figure_request.hpp"

#include <string>
#include <vector>

#include "core/error.hpp"
#include "results/figures/figure_data.hpp"
#include "results/schema/axis_values.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;

FigureSpec asking_for(const std::string& y) {
  FigureSpec spec;
  spec.y = {y};
  return spec;
}

TEST_CASE("values of axes are written with commas, also between brackets") {
  AxisValues chosen;
  add_axis_values(chosen, "range_sigma_m=0.1, 0.3");
  add_axis_values(chosen, "depth_m = [1, 5],[1,10]");
  add_axis_values(chosen, "range_sigma_m=0.5");
  AxisValues formulas;
  add_axis_values(formulas, "k_expr=max(alpha, min(n, 2)), n");
  CHECK(formulas["k_expr"] == std::vector<std::string>{"max(alpha, min(n, 2))", "n"});
  CHECK(chosen == AxisValues{{"depth_m", {"[1, 5]", "[1,10]"}}, {"range_sigma_m", {"0.1", "0.3", "0.5"}}});
  AxisValues again;
  for (const std::string& text : axis_values_texts(chosen)) add_axis_values(again, text);
  CHECK(again == chosen);
  for (const char* wrong : {"", "points", "points=", "=3", "points=3,,4"}) {
    CHECK_THROWS_AS(add_axis_values(chosen, wrong), core::InputError);
  }
}

TEST_CASE("a value is what its text means") {
  CHECK(is_written_as(0.1, "0.10"));
  CHECK(is_written_as(std::int64_t{3}, "3.0"));
  CHECK(is_written_as(std::string("[1.0, 5.0]"), "[1,5]"));
  CHECK(is_written_as(std::string("mad"), "mad"));
  CHECK_FALSE(is_written_as(0.1, "0.1000001"));
  CHECK_FALSE(is_written_as(std::string("[1.0, 5.0]"), "[1,5,6]"));
  CHECK_FALSE(is_written_as(std::string("mad"), "3"));
}

TEST_CASE("a figure that names y alone gets an axis and lines") {
  const Header header = synthetic_summary().header;
  const FigureSpec whole = completed_figure(header, asking_for("error_m"));
  CHECK(whole.name == "error_m");
  CHECK(whole.x == "points");
  CHECK(whole.group == std::vector<std::string>{"range_sigma_m"});

  FigureSpec spec = asking_for("error_m");
  spec.facet = "points";
  CHECK(completed_figure(header, spec).x == "range_sigma_m");
  CHECK(completed_figure(header, spec).group.empty());
  spec = asking_for("error_m");
  spec.where = {{"points", {"5"}}};
  CHECK(completed_figure(header, spec).x == "range_sigma_m");
  CHECK(completed_figure(header, spec).group.empty());
}

TEST_CASE("axes that move together need no lines of their own") {
  Header header = synthetic_summary().header;
  header.cells = {{"c0", {0, 0}}, {"c1", {1, 1}}};
  CHECK(completed_figure(header, asking_for("error_m")).group.empty());
}

TEST_CASE("without a further axis there is no figure") {
  Header header = synthetic_summary().header;
  FigureSpec spec = asking_for("error_m");
  spec.facet = "points";
  spec.group = {"range_sigma_m"};
  CHECK_THROWS_AS(completed_figure(header, spec), core::InputError);
  header.axes.clear();
  header.cells = {{"c0", {}}};
  CHECK_THROWS_AS(completed_figure(header, asking_for("error_m")), core::InputError);
}

TEST_CASE("where keeps the cells with these values, and the ticks at which they stand") {
  FigureSpec spec = asking_for("error_m");
  spec.x = "range_sigma_m";
  spec.group = {"points"};
  spec.where = {{"points", {"5"}}, {"range_sigma_m", {"0.50"}}};
  const FigureData data = figure_data(synthetic_summary(), spec);
  REQUIRE(data.x_ticks.size() == 1);
  CHECK(data.x_ticks[0].label == "0.5");
  REQUIRE(data.panels.size() == 1);
  REQUIRE(data.panels[0].lines.size() == 2);  // rr and rrr
  CHECK(data.panels[0].lines[0].points.size() == 1);
}

TEST_CASE("where without a cell is refused") {
  Summary summary = synthetic_summary();
  summary.header.cells.pop_back();
  FigureSpec spec = asking_for("error_m");
  spec.where = {{"points", {"5"}}, {"range_sigma_m", {"0.5"}}};
  CHECK_THROWS_AS(completed_figure(summary.header, spec), core::InputError);
}

}  // namespace
