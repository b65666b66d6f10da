#pragma once

#include <string>
#include <vector>

#include "results/figures/figure_data.hpp"
#include "results/pictures/page.hpp"

namespace ridgeloc::results {

struct PanelLayout {
  double label_y = 0.0;
  double top = 0.0;
  double bottom = 0.0;
};

struct LegendEntry {
  enum class Kind { Group, Metric, Bound };

  double x = 0.0;
  double y = 0.0;
  Kind kind = Kind::Group;
  std::size_t index = 0;  ///< into `FigureData::groups`, `metrics` or `bounds`
};

/// Where everything stands on the page: millimetres from the upper left corner; texts by their middle line.
struct FigureLayout {
  static constexpr double width = 85.0;  ///< one column of a journal

  double height = 0.0;
  double left = 0.0;
  double title_y = 0.0;
  double conditions_y = 0.0;
  double legend_title_y = 0.0;
  double x_label_y = 0.0;
  double footnote_y = 0.0;
  std::vector<std::string> title;       ///< lines
  std::vector<std::string> conditions;  ///< lines
  std::vector<std::string> y_label;     ///< lines
  std::vector<std::string> footnote;    ///< lines
  std::vector<LegendEntry> legend;
  std::vector<PanelLayout> panels;
  std::vector<FigureTick> ticks;  ///< labels are empty where there is no room
  double dodge = 0.0;             ///< sideways step from line to line, in x (log x: in its decimal logarithm)
  AxisRange x;
  AxisRange y;
};

FigureLayout figure_layout(const FigureData& data);

/// Whether a point has a place on the page: finite, and positive on a logarithmic axis.
bool is_drawable(const FigurePoint& point, bool log_y);

/// x of a line's points, moved a little sideways so that error bars of different lines stand beside each
/// other.
double dodged(const FigureData& data, const FigureLayout& layout, const FigureLine& line, double x);

/// The points of a bound; one that has a single point reaches a little to both sides of it, to be seen.
std::vector<FigurePoint> drawn_bound(const FigureData& data, const FigureLayout& layout, const FigureBound& bound);

}  // namespace ridgeloc::results
