#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/pictures/drawing.hpp"
#include "results/pictures/page.hpp"

namespace ridgeloc::results {

/// What of a path lies in the window.
struct VisiblePath {
  std::vector<std::vector<DrawnPoint>> pieces;
  std::vector<DrawnPoint> marks;  ///< but for the last point of the path
  std::optional<DrawnPoint> end;  ///< that last point
  struct Arrow {
    DrawnPoint from;
    DrawnPoint to;
  };
  std::optional<Arrow> arrow;  ///< the end of the last piece, where the path ends outside
};
VisiblePath visible(const DrawnPath& path, const DrawingWindow& window);

/// A text on the page, in millimetres from the upper left corner; x is its middle.
struct PlacedText {
  double x = 0.0;
  double y = 0.0;
  std::string text;
};

/// Where everything stands on the page, in millimetres from the upper left corner; texts by their middle line.
struct DrawingLayout {
  static constexpr double width = 120.0;

  double height = 0.0;
  double left = 0.0;  ///< edges of the plot
  double right = 0.0;
  double top = 0.0;
  double bottom = 0.0;
  double title_y = 0.0;
  double x_label_y = 0.0;
  double footnote_y = 0.0;
  std::vector<std::string> title;  ///< lines
  std::vector<std::string> footnote;
  std::vector<LegendGrid::Place> legend;  ///< of `legend_texts`
  std::vector<VisiblePath> paths;
  std::vector<PlacedText> texts;  ///< of the places, beside their points so that as little as possible is covered
};

DrawingLayout drawing_layout(const Drawing& drawing);

/// What the legend names: paths, and in columns of their own places and contours.
std::vector<std::string> legend_texts(const Drawing& drawing);

}  // namespace ridgeloc::results
