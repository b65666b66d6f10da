#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "results/pictures/page.hpp"

namespace ridgeloc::results {

struct DrawnPoint {
  double x = 0.0;
  double y = 0.0;
};

/// A line with a mark at every point and a larger one at the last. Paths differ by colour, mark and dash; where they
/// lie on each other, earlier ones show as broader lines.
struct DrawnPath {
  std::string label;
  std::string note;  ///< after the label in the legend, may be empty
  std::vector<DrawnPoint> points;
  bool filled_end = true;  ///< otherwise the mark at the last point is hollow
};

enum class DrawnMark {
  Dot,  ///< grey
  Plus,
  Square,   ///< hollow
  Diamond,  ///< hollow, around what stands there
  Triangle  ///< hollow, around what stands there
};

/// Places of one kind.
struct DrawnPlaces {
  std::string label;
  DrawnMark mark = DrawnMark::Dot;
  std::vector<DrawnPoint> points;
  std::vector<std::string> texts;  ///< beside the points; or none at all
  std::vector<std::size_t> paths;  ///< whose colours the marks have; none: the mark's own
};

/// Curves along which a function of the plane is constant.
struct DrawnContours {
  std::string label;
  std::vector<std::vector<double>> values;  ///< over the window: row i is y from low to high, column j is x; NaN: none
  std::vector<double> levels;
};

/// The part of the plane that a picture shows.
struct DrawingWindow {
  AxisRange x;
  AxisRange y;

  bool contains(const DrawnPoint& point) const {
    return point.x >= x.low && point.x <= x.high && point.y >= y.low && point.y <= y.high;
  }
};

/// The smallest window around another that has the proportions of a picture: between 0.5 and 1.1 times as high as wide.
DrawingWindow fitted(DrawingWindow window);

/// A picture of lines, places and contours in a plane, both axes in one scale. Paths that leave the window are cut off
/// there, with an arrow; the footnote says where they end.
struct Drawing {
  std::string title;
  std::string x_label;
  std::string y_label;
  DrawingWindow window;  ///< `fitted`
  std::vector<DrawnPath> paths;
  std::vector<DrawnPlaces> places;
  std::optional<DrawnContours> contours;
  std::string footnote;
};

/// Draws a picture into a file; see `write_picture` for formats and errors.
void draw(const Drawing& drawing, const std::filesystem::path& output);

}  // namespace ridgeloc::results
