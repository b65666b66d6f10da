#include "results/figures/figure_layout.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "results/figures/figure_axes.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/numbers.hpp"

namespace {

using namespace ridgeloc::results;
using ridgeloc::tests::infinity;

/// Two lines over the given values of x.
FigureData two_lines(const std::vector<double>& xs) {
  FigureData data;
  data.groups = {"first", "second"};
  data.metrics = {""};
  data.scales = {{"height", false}};
  data.panels = {{"", 0, {{0, 0, {}}, {1, 0, {}}}}};
  for (const double x : xs) {
    data.x_ticks.push_back({x, "label"});
    for (FigureLine& line : data.panels[0].lines) line.points.push_back({x, 2.0, 1.5, 2.5, true});
  }
  data.footnote = std::string("note");
  return data;
}

TEST_CASE("bars lie within the range, which begins at zero where zero is near") {
  const FigureLayout near_zero = figure_layout([] {
    FigureData data = two_lines({1.0, 2.0});
    data.panels[0].lines[0].points[0].lo = 0.1;
    return data;
  }());
  CHECK(near_zero.panels[0].y.low == 0.0);
  CHECK(near_zero.panels[0].y.high > 2.5);
  const FigureLayout far = figure_layout(two_lines({1.0, 2.0}));
  CHECK(far.panels[0].y.low > 0.0);
  CHECK(far.panels[0].y.low < 1.5);
}

TEST_CASE("infinite points and ends do not stretch the range, and are counted") {
  FigureData data = two_lines({1.0, 2.0});
  data.panels[0].lines[0].points[0] = {1.0, infinity, 2.0, infinity, true};
  data.panels[0].lines[1].points[0].hi = infinity;
  const FigureLayout layout = figure_layout(data);
  CHECK(layout.panels[0].y.high < 3.0);
  REQUIRE(layout.footnote.size() == 1);
  CHECK(layout.footnote[0] == "note; 1 point not shown: infinite");
}

TEST_CASE("a logarithmic range leaves out what is not positive") {
  FigureData data = two_lines({1.0, 2.0});
  data.scales[0].log = true;
  data.panels[0].lines[0].points[0] = {1.0, 0.0, 0.0, 0.1, true};
  data.panels[0].lines[1].points[0].lo = -1.0;
  const FigureLayout layout = figure_layout(data);
  CHECK(layout.panels[0].y.low > 0.5);
  CHECK_FALSE(is_drawable(data.panels[0].lines[0].points[0], true));
  CHECK(is_drawable(data.panels[0].lines[0].points[0], false));
}

TEST_CASE("long labels of a logarithmic axis have room beside it") {
  FigureData data = two_lines({1.0, 2.0});
  data.scales[0].log = true;
  const double left = figure_layout(data).panels[0].left;
  data.panels[0].lines[0].points[0].y = data.panels[0].lines[0].points[0].lo = 5e-5;
  CHECK(figure_layout(data).panels[0].left > left);  // 0.0001
}

TEST_CASE("tick labels that have no room are left out") {
  std::vector<double> dense;
  for (int i = 0; i < 60; ++i) dense.push_back(i);
  const FigureLayout layout = figure_layout(two_lines(dense));
  const auto labelled = std::count_if(layout.ticks.begin(), layout.ticks.end(),
                                      [](const FigureTick& tick) { return !tick.label.empty(); });
  CHECK(layout.ticks.size() == 60);
  CHECK(labelled > 3);
  CHECK(labelled < 15);
}

TEST_CASE("panels and texts follow each other down the page") {
  FigureData data = two_lines({1.0, 2.0});
  data.title = std::string("title");
  data.panels[0].label = std::string("first");
  data.panels.push_back(data.panels[0]);
  const FigureLayout layout = figure_layout(data);
  REQUIRE(layout.panels.size() == 2);
  REQUIRE(layout.legend.size() == 2);
  CHECK(layout.title_y < layout.legend[0].y);
  CHECK(layout.legend[1].y < layout.panels[0].label_y);
  CHECK(layout.panels[0].label_y < layout.panels[0].top);
  CHECK(layout.panels[0].bottom < layout.panels[1].label_y);
  CHECK(layout.panels[1].bottom < layout.x_label_y);
  CHECK(layout.x_label_y < layout.footnote_y);
  CHECK(layout.footnote_y < layout.page.height);
}

TEST_CASE("what was never seen stands at its upper bound on a logarithmic axis, and the footnote says so") {
  FigureData data = two_lines({1.0, 2.0});
  data.scales[0].log = true;
  data.panels[0].lines[0].points[0] = {1.0, 0.0, 0.0, 0.01, false, true};
  const FigureLayout layout = figure_layout(data);
  CHECK(layout.panels[0].y.low < 0.01);
  CHECK(layout.footnote.front().starts_with("note; open triangles: not seen once"));
  data.scales[0].log = false;
  CHECK(figure_layout(data).footnote.front() == "note");
}

TEST_CASE("panels stand in columns, the horizontal axis below the last of each") {
  FigureData data = two_lines({1.0, 2.0});
  data.panels.resize(5, data.panels[0]);
  data.view.columns = 2;
  const FigureLayout layout = figure_layout(data);
  CHECK(layout.page.width == 170.0);
  const auto& p = layout.panels;
  CHECK(p[0].right < p[1].left);
  CHECK(p[1].right < layout.page.width);
  CHECK(p[0].top == p[1].top);
  CHECK(p[0].left == p[4].left);
  CHECK(p[2].bottom < p[4].top);
  const bool lowest[] = {false, false, false, true, true};
  for (std::size_t i = 0; i < p.size(); ++i) CHECK(p[i].is_lowest == lowest[i]);
  CHECK(layout.y_labels.size() == 1);
}

TEST_CASE("quantities of different units have axes and labels of their own beside each other") {
  FigureData data = two_lines({1.0, 2.0});
  data.scales.push_back({"rate", false});
  data.panels.push_back(data.panels[0]);
  data.panels[1].scale = 1;
  for (FigureLine& line : data.panels[1].lines)
    for (FigurePoint& point : line.points) point = {point.x, 0.5, 0.4, 0.6};
  const FigureLayout layout = figure_layout(data);
  CHECK(layout.page.width == 170.0);
  CHECK(layout.panels[0].top == layout.panels[1].top);
  CHECK(layout.panels[1].y.high < 1.0);
  CHECK(layout.panels[0].y.high > 2.0);
  REQUIRE(layout.y_labels.size() == 2);
  CHECK(layout.y_labels[1].lines == std::vector<std::string>{"rate"});
  CHECK(layout.y_labels[0].x < layout.panels[0].left);
  CHECK(layout.panels[0].right < layout.y_labels[1].x);
}

TEST_CASE("a figure has the size and the limits that are asked for") {
  FigureData data = two_lines({1.0, 2.0, 3.0});
  data.view.size = Page{120.0, 90.0};
  data.view.x = AxisRange{1.5, 3.5};
  data.view.y = AxisRange{-1.0, 7.0};
  const FigureLayout layout = figure_layout(data);
  CHECK(layout.page.width == 120.0);
  CHECK(layout.page.height == Approx(90.0));
  CHECK(layout.x.low == 1.5);
  CHECK(layout.panels[0].y.high == 7.0);
  CHECK(layout.ticks.size() == 2);
  CHECK(layout.footnote == std::vector<std::string>{"note; 2 points outside of the axes"});
  data.view.size = Page{40.0, 20.0};
  const std::string message = ridgeloc::tests::refusal_of([&] { figure_layout(data); });
  CHECK(message.find("--size 40x20: this figure needs at least 40x") == 0);
  data.view.size.reset();
  data.scales[0].log = true;
  CHECK(ridgeloc::tests::refusal_of([&] { figure_layout(data); }) ==
        "--ylim -1:7: the axis is logarithmic; both ends have to be above 0");
}

TEST_CASE("categories whose texts have no room beside each other are numbered, with a key below the axis") {
  FigureData data = two_lines({0.0, 1.0, 2.0});
  data.is_categorical = true;
  CHECK(figure_layout(data).key.empty());
  CHECK(figure_layout(data).ticks.at(2).label == "label");
  const std::string formula = "max(eigenvalues) * sigma2 / max(alpha^2)";
  data.x_ticks[1].label = formula;
  data.x_ticks[2].label = std::string(100, 'x');
  const FigureLayout layout = figure_layout(data);
  CHECK(layout.ticks.at(0).label == "(1)");
  CHECK(layout.ticks.at(2).label == "(3)");
  REQUIRE(layout.key.size() == 4);
  CHECK(layout.key[0] == "(1) label");
  CHECK(layout.key[1] == "(2) " + formula);
  CHECK(layout.x_label_y < layout.key_y);
  CHECK(layout.key_y + 4 * PageStyle::footnote_line_height < layout.footnote_y + 0.01);
  CHECK(layout.x.low == -0.5);
  CHECK(layout.x.high == 2.5);
}

TEST_CASE("a legend text that is longer than the page is wide takes several lines") {
  FigureData data = two_lines({1.0, 2.0});
  data.bounds = {"bound of unbiased estimates, median and quartiles (points = 3, range_sigma_m = 0.1)"};
  data.groups[1] = std::string(60, 'x');
  const FigureLayout layout = figure_layout(data);
  REQUIRE(layout.legend.size() == 3);
  CHECK(layout.legend[0].lines.size() == 1);
  CHECK(layout.legend[1].lines.size() == 2);
  CHECK(layout.legend[2].lines.size() == 2);
  CHECK(layout.legend[2].y == Approx(layout.legend[1].y + 2 * PageStyle::line_height));
  const double end = PageStyle::edge + PageStyle::sample_length + PageStyle::sample_gap;
  for (const LegendEntry& entry : layout.legend)
    for (const std::string& line : entry.lines)
      CHECK(end + small_character * static_cast<double>(line.size()) < layout.page.width);
}

TEST_CASE("a long label of the horizontal axis stands in lines above its key and the footnote") {
  FigureData data = two_lines({1.0, 2.0});
  data.x_label = "number of points";
  const FigureLayout one = figure_layout(data);
  CHECK(one.x_label.size() == 1);
  data.x_label = "number of points (standard deviation of the range errors [m])";
  const FigureLayout two = figure_layout(data);
  CHECK(two.x_label.size() == 2);
  CHECK(two.footnote_y == Approx(one.footnote_y + PageStyle::line_height));
  CHECK(two.page.height == Approx(one.page.height + PageStyle::line_height));
}

TEST_CASE("a bound is a line along numbers, and a stroke at each category") {
  FigureData data = two_lines({0.0, 1.0});
  const FigureBound bound{0, {}, false, {{0.0, 2.0, 2.0, 2.0}, {1.0, 2.2, 2.2, 2.2}}};
  CHECK(drawn_bound(data, figure_layout(data), bound, false).size() == 1);
  data.is_categorical = true;
  const auto strokes = drawn_bound(data, figure_layout(data), bound, false);
  REQUIRE(strokes.size() == 2);
  CHECK(strokes[1].front().x == Approx(1.0 - 0.35));
  CHECK(strokes[1].back().x == Approx(1.0 + 0.35));
}

TEST_CASE("text is broken at spaces") {
  CHECK(wrapped("one two three", 7) == std::vector<std::string>{"one two", "three"});
  CHECK(wrapped("unbreakable", 3) == std::vector<std::string>{"unbreakable"});
  CHECK(wrapped("  a  b ", 10) == std::vector<std::string>{"a b"});
  CHECK(wrapped("", 10).empty());
  CHECK(broken("sigma2/trace + n", 7) == std::vector<std::string>{"sigma2/", "trace +", "n"});
  CHECK(broken("größen", 3) == std::vector<std::string>{"grö", "ßen"});
  CHECK(broken("(1) sigma2+trace", 8) == std::vector<std::string>{"(1) sigm", "a2+trace"});
}

}  // namespace
