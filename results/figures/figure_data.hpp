#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/figures/figure_view.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// One marker with its 95 % interval. `y`, `lo` and `hi` may be infinite.
struct FigurePoint {
  double x = 0.0;
  double y = 0.0;
  double lo = 0.0;
  double hi = 0.0;
  bool trusted = true;
  bool never_seen = false;  ///< the rate of what did not happen once; `hi` is its one-sided 95 % upper bound
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

/// A vertical axis. Quantities of one unit and statistic share one, others have panels of their own.
struct FigureScale {
  std::string label;
  bool log = false;
};

struct FigurePanel {
  std::string label;      ///< the setting that all of it shares; empty where there is none
  std::size_t scale = 0;  ///< index into `FigureData::scales`
  std::vector<FigureLine> lines = {};
  std::vector<FigureBound> bounds = {};
};

struct FigureTick {
  double position = 0.0;
  std::string label;
};

/// More bands in a panel would hide each other.
inline constexpr std::size_t most_bands = 3;

/// How the lines of a figure are drawn.
enum class FigureStyle {
  Marks,  ///< marks with error bars, joined by lines
  Bands,  ///< lines alone, each within the band of its intervals
  Lines   ///< lines alone
};

/// A figure with all names resolved and all numbers in place: what is left is to draw it.
struct FigureData {
  std::string title;
  std::string conditions;  ///< values of axes that all cells shown share; may be empty
  std::string x_label;
  std::vector<FigureScale> scales;
  std::vector<FigureTick> x_ticks;  ///< at the values of the axis; categories stand at 0, 1, 2, ...
  bool log_x = false;
  bool is_categorical = false;  ///< the axis has no numbers: nothing lies between its values, and no line joins them
  FigureStyle style = FigureStyle::Marks;
  std::string group_title;           ///< what the legend texts of the groups are values of; may be empty
  std::vector<std::string> groups;   ///< legend texts; one empty text where nothing is grouped
  std::vector<std::string> metrics;  ///< legend texts; one empty text where no panel has several
  std::vector<std::string> bounds;   ///< legend texts
  std::vector<FigurePanel> panels;
  std::string footnote;
  FigureView view = {};
};

/// Resolves a figure. Methods that report none of its metrics are left out. Where several methods are drawn
/// and neither `group` nor `facet` names "method", they become groups.
///
/// Throws core::InputError for a name that does not exist (with the nearest ones that do), for an unknown
/// statistic, for the distribution of what has negative values, when cells that differ in an axis which the figure
/// does not name would fall on the same point, or line of a distribution, for more lines in a panel than can be told
/// apart, and for a logarithmic axis of what is not positive.
FigureData figure_data(const Summary& summary, const FigureSpec& spec, const FigureView& view = {});

/// What there is to see, in words.
std::string description_of(const FigureData& data);

}  // namespace ridgeloc::results
