#include "results/figures/figure_bars.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "results/figures/figure_axes.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace ridgeloc::results;

/// As many lines, all with the same bars at 1, 10 and 100.
FigureData equal_lines(std::size_t count, double half_bar) {
  FigureData data;
  data.metrics = {""};
  data.scales = {{"", false}};
  data.panels.resize(1);
  for (std::size_t i = 0; i < count; ++i) {
    data.groups.emplace_back("line");
    FigureLine line{i, 0, {}};
    for (const double x : {1.0, 10.0, 100.0}) line.points.push_back({x, 2.0, 2.0 - half_bar, 2.0 + half_bar});
    data.panels[0].lines.push_back(line);
  }
  for (const double x : {1.0, 10.0, 100.0}) data.x_ticks.push_back({x, "x"});
  return data;
}

/// Distance of two places on the horizontal axis, in millimetres.
double distance(const FigureData& data, const FigureLayout& layout, double a, double b) {
  const PanelLayout& panel = layout.panels[0];
  return (share_of_axis(layout.x, data.log_x, b) - share_of_axis(layout.x, data.log_x, a)) * (panel.right - panel.left);
}

TEST_CASE("bars that overlap stand beside each other by less than a line, within the width of their mark") {
  for (const bool log_x : {false, true}) {
    for (const std::size_t lines : {2, 3, 9, 30}) {
      FigureData data = equal_lines(lines, 1.0);
      data.log_x = log_x;
      const FigureLayout layout = figure_layout(data);
      const auto places = bar_places(data, layout, 0);
      for (std::size_t point = 0; point < 3; ++point) {
        const double x = data.panels[0].lines[0].points[point].x;
        for (std::size_t i = 0; i < lines; ++i) {
          CHECK(std::abs(distance(data, layout, x, places[i][point])) <= 0.65 + 1e-9);
          if (i == 0) continue;
          const double step = distance(data, layout, places[i - 1][point], places[i][point]);
          CHECK(step > 0.0);
          CHECK(step < 0.32);
        }
        CHECK(distance(data, layout, places[0][point], x) == Approx(distance(data, layout, x, places.back()[point])));
      }
    }
  }
}

TEST_CASE("bars that do not overlap, or that a mark hides, stay at the true x") {
  FigureData hidden = equal_lines(9, 0.0001);
  hidden.panels[0].lines[0].points[2].hi = 50.0;  // the axis is long
  const auto places = bar_places(hidden, figure_layout(hidden), 0);
  for (const auto& line : places) CHECK(line == std::vector<double>{1.0, 10.0, 100.0});

  FigureData apart = equal_lines(2, 0.5);
  for (FigurePoint& point : apart.panels[0].lines[1].points) point = {point.x, 5.0, 4.5, 5.5};
  for (const auto& line : bar_places(apart, figure_layout(apart), 0))
    CHECK(line == std::vector<double>{1.0, 10.0, 100.0});
}

}  // namespace
