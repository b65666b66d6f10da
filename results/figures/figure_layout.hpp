#pragma once

#include <string>
#include <vector>

#include "results/figures/figure_data.hpp"
#include "results/pictures/page.hpp"

namespace ridgeloc::results {

struct PanelLayout {
  double label_y = 0.0;
  double left = 0.0;  ///< ends of the axes
  double right = 0.0;
  double top = 0.0;
  double bottom = 0.0;
  AxisRange y;
  bool is_lowest = false;  ///< of its column: the horizontal axis has its labels here
};

/// The label of vertical axes, from bottom to top.
struct SideLabel {
  double x = 0.0;  ///< of the first line
  double y = 0.0;  ///< of the middle
  std::vector<std::string> lines;
};

struct LegendEntry {
  enum class Kind { Group, Metric, Bound };

  double x = 0.0;
  double y = 0.0;
  Kind kind = Kind::Group;
  std::size_t index = 0;  ///< into `FigureData::groups`, `metrics` or `bounds`
  std::vector<std::string> lines = {};
};

/// Where everything stands on the page: millimetres from the upper left corner; texts by their middle line.
struct FigureLayout {
  Page page;
  double title_y = 0.0;
  double conditions_y = 0.0;
  double legend_title_y = 0.0;
  double x_label_x = 0.0;
  double x_label_y = 0.0;
  double key_y = 0.0;
  double footnote_y = 0.0;
  std::vector<std::string> key;           ///< lines: what the numbers below the axis stand for; empty if it has none
  std::vector<std::string> x_label;       ///< lines
  std::vector<std::string> legend_title;  ///< lines
  std::vector<std::string> title;         ///< lines
  std::vector<std::string> conditions;    ///< lines
  std::vector<std::string> footnote;      ///< lines
  std::vector<SideLabel> y_labels;
  std::vector<LegendEntry> legend;
  std::vector<PanelLayout> panels;
  std::vector<FigureTick>
      ticks;  ///< within the axis; labels are empty where there is no room, those of categories numbers
  AxisRange x;
};

/// Panels stand in columns, row by row; a column is as wide as that of a journal, 85 mm, unless a size is asked for.
/// Throws core::InputError for a size in which the panels have no room, and for limits that do not go with a
/// logarithmic axis.
FigureLayout figure_layout(const FigureData& data);

/// The points of a bound, one list for each stretch that a line joins. A stretch of a single point, as each of an axis
/// of categories, reaches to both sides of it, to be seen.
std::vector<std::vector<FigurePoint>> drawn_bound(const FigureData& data, const FigureLayout& layout,
                                                  const FigureBound& bound, bool log_y);

}  // namespace ridgeloc::results
