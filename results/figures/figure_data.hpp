#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// One marker with its 95 % interval. `y`, `lo` and `hi` may be infinite.
struct FigurePoint {
  double x = 0.0;
  double y = 0.0;
  double lo = 0.0;
  double hi = 0.0;
  bool trusted = true;
};

/// The points of one metric in one group, in order of x.
struct FigureLine {
  std::size_t group = 0;   ///< index into `FigureData::groups`
  std::size_t metric = 0;  ///< index into `FigureData::metrics`
  std::vector<FigurePoint> points;
};

/// What points are to be seen against, a bound or what is expected of them: a line without marks, in order of x.
struct FigureBound {
  std::size_t entry = 0;                  ///< index into `FigureData::bounds`
  std::optional<std::size_t> group = {};  ///< whose colour it has; none where it belongs to several
  bool has_band = false;                  ///< from lo to hi
  std::vector<FigurePoint> points = {};
};

struct FigurePanel {
  std::string label;  ///< empty where there is one panel only
  std::vector<FigureLine> lines;
  std::vector<FigureBound> bounds = {};
};

struct FigureTick {
  double position = 0.0;
  std::string label;
};

/// How the lines of a figure are drawn.
enum class FigureStyle {
  Marks,  ///< marks with error bars, those of different lines beside each other, joined by lines
  Bands,  ///< lines alone, each within the band of its intervals
  Lines   ///< lines alone
};

/// A figure with all names resolved and all numbers in place: what is left is to draw it.
struct FigureData {
  std::string title;
  std::string conditions;  ///< values of axes that all cells shown share; may be empty
  std::string x_label;
  std::string y_label;
  std::vector<FigureTick> x_ticks;  ///< at the values of the axis; categories stand at 0, 1, 2, ...
  bool log_x = false;               ///< an axis of positive numbers that spans at least a factor of 100
  bool log_y = false;
  FigureStyle style = FigureStyle::Marks;
  std::string group_title;           ///< what the legend texts of the groups are values of; may be empty
  std::vector<std::string> groups;   ///< legend texts; one empty text where nothing is grouped
  std::vector<std::string> metrics;  ///< legend texts; one empty text where there is one metric only
  std::vector<std::string> bounds;   ///< legend texts
  std::vector<FigurePanel> panels;
  std::string footnote;
};

/// Resolves a figure. Methods that report none of its metrics are left out. Where several methods are drawn
/// and neither `group` nor `facet` names "method", they become groups.
///
/// Throws core::InputError for a name that does not exist (with the nearest ones that do), for an unknown
/// statistic, for the distribution of what has negative values, and when cells that differ in an axis which the figure
/// does not name would fall on the same point, or line of a distribution.
FigureData figure_data(const Summary& summary, const FigureSpec& spec);

}  // namespace ridgeloc::results
