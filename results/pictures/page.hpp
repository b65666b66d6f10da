#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// What all pictures share of their pages, in millimetres. Widths of text are estimated from the number of characters,
/// because no font can be relied on.
namespace ridgeloc::results {

/// The limits of a coordinate axis.
struct AxisRange {
  double low = 0.0;
  double high = 1.0;
};

struct Page {
  double width = 0.0;   ///< mm
  double height = 0.0;  ///< mm
};

/// Distances on a page.
struct PageStyle {
  static constexpr double edge = 2.0;
  static constexpr double right = 3.0;
  static constexpr double line_height = 3.6;
  static constexpr double footnote_line_height = 2.6;
  static constexpr double sample_length = 7.0;  ///< of a line in the legend
  static constexpr double sample_gap = 1.2;     ///< between it and its text
};

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

/// The same, with longer words broken too: for formulas, which may have no space.
std::vector<std::string> broken(std::string_view text, std::size_t most);

}  // namespace ridgeloc::results
