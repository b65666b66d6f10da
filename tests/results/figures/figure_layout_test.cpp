#include "results/figures/figure_layout.hpp"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "tests/support/catch.hpp"

namespace {

using namespace ridgeloc::results;

/// Two lines over the given values of x.
FigureData two_lines(const std::vector<double>& xs) {
  FigureData data;
  data.groups = {"first", "second"};
  data.metrics = {""};
  data.panels = {{"", {{0, 0, {}}, {1, 0, {}}}}};
  for (const double x : xs) {
    data.x_ticks.push_back({x, "label"});
    for (FigureLine& line : data.panels[0].lines) line.points.push_back({x, 2.0, 1.5, 2.5, true});
  }
  data.footnote = std::string("note");
  return data;
}

TEST_CASE("lines stand beside each other around their value, within the axis") {
  for (const bool log_x : {false, true}) {
    FigureData data = two_lines({1.0, 10.0, 100.0});
    data.log_x = log_x;
    const FigureLayout layout = figure_layout(data);
    const auto& lines = data.panels[0].lines;
    for (const double x : {1.0, 10.0, 100.0}) {
      const double left = dodged(data, layout, lines[0], x);
      const double right = dodged(data, layout, lines[1], x);
      CHECK(left < x);
      CHECK(x < right);
      CHECK(layout.x.low < left);
      CHECK(right < layout.x.high);
    }
  }
}

TEST_CASE("bars lie within the range, which begins at zero where zero is near") {
  const FigureLayout near_zero = figure_layout([] {
    FigureData data = two_lines({1.0, 2.0});
    data.panels[0].lines[0].points[0].lo = 0.1;
    return data;
  }());
  CHECK(near_zero.y.low == 0.0);
  CHECK(near_zero.y.high > 2.5);
  const FigureLayout far = figure_layout(two_lines({1.0, 2.0}));
  CHECK(far.y.low > 0.0);
  CHECK(far.y.low < 1.5);
}

TEST_CASE("infinite points and ends do not stretch the range, and are counted") {
  FigureData data = two_lines({1.0, 2.0});
  const double infinity = std::numeric_limits<double>::infinity();
  data.panels[0].lines[0].points[0] = {1.0, infinity, 2.0, infinity, true};
  data.panels[0].lines[1].points[0].hi = infinity;
  const FigureLayout layout = figure_layout(data);
  CHECK(layout.y.high < 3.0);
  REQUIRE(layout.footnote.size() == 1);
  CHECK(layout.footnote[0] == "note; 1 point not shown: infinite");
}

TEST_CASE("a logarithmic range leaves out what is not positive") {
  FigureData data = two_lines({1.0, 2.0});
  data.log_y = true;
  data.panels[0].lines[0].points[0] = {1.0, 0.0, 0.0, 0.1, true};
  data.panels[0].lines[1].points[0].lo = -1.0;
  const FigureLayout layout = figure_layout(data);
  CHECK(layout.y.low > 0.5);
  CHECK_FALSE(is_drawable(data.panels[0].lines[0].points[0], true));
  CHECK(is_drawable(data.panels[0].lines[0].points[0], false));
}

TEST_CASE("long labels of a logarithmic axis have room beside it") {
  FigureData data = two_lines({1.0, 2.0});
  data.log_y = true;
  const double left = figure_layout(data).left;
  data.panels[0].lines[0].points[0].y = data.panels[0].lines[0].points[0].lo = 5e-5;
  CHECK(figure_layout(data).left > left);  // 0.0001
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
  CHECK(layout.footnote_y < layout.height);
}

TEST_CASE("text is broken at spaces") {
  CHECK(wrapped("one two three", 7) == std::vector<std::string>{"one two", "three"});
  CHECK(wrapped("unbreakable", 3) == std::vector<std::string>{"unbreakable"});
  CHECK(wrapped("  a  b ", 10) == std::vector<std::string>{"a b"});
  CHECK(wrapped("", 10).empty());
}

}  // namespace
