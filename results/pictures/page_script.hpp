#pragma once

#include <array>
#include <string>
#include <string_view>

#include "results/pictures/page.hpp"

/// What gnuplot scripts of all pictures share. Places on the page are in millimetres from its upper left corner.
namespace ridgeloc::results {

/// File formats of pictures; the file extension says which.
enum class FigureFormat { Svg, Pdf, Png };

/// Okabe and Ito's palette for all kinds of colour vision, without its yellow, which is too light for lines, and three
/// of Tol's muted colours; ordered so that neighbours differ in lightness too.
inline constexpr std::array colours = {"#0072b2", "#d55e00", "#000000", "#009e73", "#cc79a7",
                                       "#56b4e9", "#e69f00", "#882255", "#999933", "#332288"};

/// gnuplot's filled point types; the open one of the same shape is the number before. The triangle that points down is
/// not among them: open, it marks an upper bound.
inline constexpr std::array filled_marks = {7, 5, 9, 13, 15};
inline constexpr int bound_mark = 10;

inline constexpr std::array dashes = {"1", "(12,5)", "(3,4)", "(12,4,3,4)", "(22,5)", "(6,3)"};

/// Those of bounds, which have no marks.
inline constexpr std::array bound_dashes = {"(14,3,2,3)", "(3,3)", "(14,3,2,3,2,3)", "(7,3)"};

/// The terminal for a page. Scales make fonts, lines and marks of the same size in all formats.
std::string terminal(FigureFormat format, const Page& page);

/// Adds an element to the list of a gnuplot command.
void append(std::string& list, std::string_view separator, std::string_view element);
inline constexpr std::string_view next_element = ", \\\n  ";

/// A plot of these elements; without any, of nothing.
std::string plot_command(const std::string& elements);

/// A label at a place on the page, with gnuplot's options for it.
std::string page_text(const Page& page, double x_mm, double y_mm, std::string_view value, std::string_view options);

/// Puts the axes of the next plot between four places on the page.
std::string margins(const Page& page, double left, double right, double top, double bottom);

std::string axis_ranges(const AxisRange& x, const AxisRange& y);

}  // namespace ridgeloc::results
