#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "results/figure_data.hpp"

namespace ridgeloc::results {

/// The limits of a coordinate axis.
struct FigureRange {
  double low = 0.0;
  double high = 1.0;
};

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
///
/// Widths of text are estimated from the number of characters, because no font can be relied on.
struct FigureLayout {
  static constexpr double width = 85.0;  ///< one column of a journal
  static constexpr double edge = 2.0;
  static constexpr double right = 3.0;
  static constexpr double line_height = 3.6;
  static constexpr double footnote_line_height = 2.6;
  static constexpr double sample_length = 7.0;  ///< of a line in the legend
  static constexpr double sample_gap = 1.2;     ///< between it and its text

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
  FigureRange x;
  FigureRange y;
};

FigureLayout figure_layout(const FigureData& data);

/// Whether a point has a place on the page: finite, and positive on a logarithmic axis.
bool is_drawable(const FigurePoint& point, bool log_y);

/// x of a line's points, moved a little sideways so that error bars of different lines stand beside each
/// other.
double dodged(const FigureData& data, const FigureLayout& layout, const FigureLine& line, double x);

/// The points of a bound; one that has a single point reaches a little to both sides of it, to be seen.
std::vector<FigurePoint> drawn_bound(const FigureData& data, const FigureLayout& layout, const FigureBound& bound);

/// Places of the entries of a legend, in columns of equal width in the middle of the page.
struct LegendGrid {
  struct Place {
    double x = 0.0;
    double y = 0.0;
  };
  std::vector<Place> places;
  double end = 0.0;  ///< where the next line goes
};
LegendGrid legend_grid(const std::vector<std::string>& texts, double y, double page_width);

/// Mean advance of a character, in millimetres: 0.53 em (a wide sans serif) of the font sizes that scripts use.
inline constexpr double title_character = 1.5;      // 8.5 pt
inline constexpr double small_character = 1.3;      // 7 pt: axes, legend, ticks
inline constexpr double footnote_character = 1.02;  // 5.5 pt

/// How many of these have room.
std::size_t characters(double millimetres, double character);

/// Breaks a text at spaces into lines of at most `most` characters (longer words stay whole).
std::vector<std::string> wrapped(std::string_view text, std::size_t most);

}  // namespace ridgeloc::results
