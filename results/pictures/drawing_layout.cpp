#include "results/pictures/drawing_layout.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "results/schema/text.hpp"

namespace ridgeloc::results {
namespace {

constexpr double lowest_proportion = 0.5;  // height over width
constexpr double highest_proportion = 1.1;

/// What a text must not cover: a disc on the page.
struct Obstacle {
  double x;
  double y;
  double radius;
};

/// Widens an interval about its middle.
AxisRange widened(const AxisRange& range, double length) {
  const double middle = 0.5 * (range.low + range.high);
  return {middle - 0.5 * length, middle + 0.5 * length};
}

/// The part of a segment that lies in the window (Liang and Barsky 1984).
struct ClippedSegment {
  DrawnPoint from;
  DrawnPoint to;
};
std::optional<ClippedSegment> clipped(const DrawnPoint& a, const DrawnPoint& b, const DrawingWindow& window) {
  double begin = 0.0;
  double end = 1.0;
  const auto cut = [&](double from, double move, const AxisRange& range) {
    if (move == 0.0) return from >= range.low && from <= range.high;
    const double low = (range.low - from) / move;
    const double high = (range.high - from) / move;
    begin = std::max(begin, std::min(low, high));
    end = std::min(end, std::max(low, high));
    return begin <= end;
  };
  if (!cut(a.x, b.x - a.x, window.x) || !cut(a.y, b.y - a.y, window.y)) return std::nullopt;
  const auto at = [&](double t) { return DrawnPoint{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)}; };
  return ClippedSegment{begin == 0.0 ? a : at(begin), end == 1.0 ? b : at(end)};
}

/// Positions on the page.
class PageScale {
 public:
  PageScale(const DrawingWindow& window, const DrawingLayout& layout)
      : window_(window), layout_(layout), scale_((layout.right - layout.left) / (window.x.high - window.x.low)) {}

  double x(double value) const { return layout_.left + (value - window_.x.low) * scale_; }
  double y(double value) const { return layout_.bottom - (value - window_.y.low) * scale_; }

 private:
  const DrawingWindow& window_;
  const DrawingLayout& layout_;
  double scale_;
};

std::vector<Obstacle> obstacles(const Drawing& drawing, const DrawingLayout& layout, const PageScale& scale) {
  constexpr double mark = 1.1;
  constexpr double line = 0.4;
  constexpr double spacing = 1.0;
  std::vector<Obstacle> found;
  for (const DrawnPlaces& places : drawing.places) {
    for (const DrawnPoint& p : places.points) found.push_back({scale.x(p.x), scale.y(p.y), mark});
  }
  for (const VisiblePath& path : layout.paths) {
    for (const DrawnPoint& p : path.marks) found.push_back({scale.x(p.x), scale.y(p.y), mark});
    if (path.end) found.push_back({scale.x(path.end->x), scale.y(path.end->y), mark});
    for (const auto& piece : path.pieces) {
      for (std::size_t i = 1; i < piece.size(); ++i) {
        const double from_x = scale.x(piece[i - 1].x);
        const double from_y = scale.y(piece[i - 1].y);
        const double move_x = scale.x(piece[i].x) - from_x;
        const double move_y = scale.y(piece[i].y) - from_y;
        const int steps = static_cast<int>(std::hypot(move_x, move_y) / spacing) + 1;
        for (int s = 0; s < steps; ++s) {
          found.push_back({from_x + move_x * s / steps, from_y + move_y * s / steps, line});
        }
      }
    }
  }
  return found;
}

/// Puts texts one after the other beside their points: of eight places around a point the first that covers least.
std::vector<PlacedText> placed_texts(const Drawing& drawing, const DrawingLayout& layout) {
  constexpr double half_height = 1.2;
  constexpr double gap = 1.0;
  constexpr std::array<std::array<int, 2>, 8> directions = {
      {{1, 0}, {-1, 0}, {0, -1}, {0, 1}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}}};
  const PageScale scale(drawing.window, layout);
  const auto discs = obstacles(drawing, layout, scale);
  std::vector<PlacedText> placed;
  const auto half_width = [](const std::string& text) {
    return 0.5 * small_character * static_cast<double>(display_width(text));
  };
  for (const DrawnPlaces& places : drawing.places) {
    for (std::size_t i = 0; i < places.texts.size(); ++i) {
      const std::string& text = places.texts[i];
      if (!drawing.window.contains(places.points[i])) continue;
      const double half = half_width(text);
      const auto at = [&](const std::array<int, 2>& direction) {
        return PlacedText{scale.x(places.points[i].x) + direction[0] * (gap + half),
                          scale.y(places.points[i].y) + direction[1] * (gap + half_height), text};
      };
      const auto covers = [&](const PlacedText& candidate) {
        std::size_t count = 0;
        for (const Obstacle& disc : discs) {
          count += std::abs(disc.x - candidate.x) < half + disc.radius &&
                           std::abs(disc.y - candidate.y) < half_height + disc.radius
                       ? 1
                       : 0;
        }
        for (const PlacedText& other : placed) {
          count += std::abs(other.x - candidate.x) < half + half_width(other.text) &&
                           std::abs(other.y - candidate.y) < 2.0 * half_height
                       ? 1
                       : 0;
        }
        const bool inside = candidate.x - half > layout.left && candidate.x + half < layout.right &&
                            candidate.y - half_height > layout.top && candidate.y + half_height < layout.bottom;
        return inside ? count : count + discs.size();
      };
      PlacedText best = at(directions[0]);
      std::size_t fewest = covers(best);
      for (const auto& direction : directions) {
        const PlacedText candidate = at(direction);
        if (const std::size_t count = covers(candidate); count < fewest) {
          best = candidate;
          fewest = count;
        }
      }
      placed.push_back(best);
    }
  }
  return placed;
}

std::string footnote(const Drawing& drawing) {
  std::string text = drawing.footnote;
  for (const DrawnPath& path : drawing.paths) {
    if (path.points.empty() || drawing.window.contains(path.points.back())) continue;
    const DrawnPoint& end = path.points.back();
    text += fmt::format("{}{} ends outside the picture, at ({:.4g}, {:.4g})", text.empty() ? "" : "; ", path.label,
                        end.x, end.y);
  }
  return text;
}

}  // namespace

DrawingWindow fitted(DrawingWindow window) {
  const double width = window.x.high - window.x.low;
  const double height = window.y.high - window.y.low;
  window.x = widened(window.x, std::max(width, height / highest_proportion));
  window.y = widened(window.y, std::max(height, width * lowest_proportion));
  return window;
}

VisiblePath visible(const DrawnPath& path, const DrawingWindow& window) {
  VisiblePath out;
  const auto same = [](const DrawnPoint& a, const DrawnPoint& b) { return a.x == b.x && a.y == b.y; };
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const auto part = clipped(path.points[i - 1], path.points[i], window);
    if (!part) continue;
    if (out.pieces.empty() || !same(out.pieces.back().back(), part->from)) out.pieces.push_back({part->from});
    out.pieces.back().push_back(part->to);
  }
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    if (window.contains(path.points[i])) out.marks.push_back(path.points[i]);
  }
  if (path.points.empty()) return out;
  if (window.contains(path.points.back())) {
    out.end = path.points.back();
  } else if (!out.pieces.empty()) {
    const auto& last = out.pieces.back();
    out.arrow = {last[last.size() - 2], last.back()};
  }
  return out;
}

std::vector<std::string> legend_texts(const Drawing& drawing) {
  std::vector<std::string> texts;
  for (const DrawnPath& path : drawing.paths) {
    texts.push_back(path.note.empty() ? path.label : fmt::format("{}: {}", path.label, path.note));
  }
  for (const DrawnPlaces& places : drawing.places) texts.push_back(places.label);
  if (drawing.contours) texts.push_back(drawing.contours->label);
  return texts;
}

DrawingLayout drawing_layout(const Drawing& drawing) {
  constexpr double edge = PageStyle::edge;
  constexpr double line = PageStyle::line_height;
  DrawingLayout layout;
  layout.left = 14.0;
  layout.right = DrawingLayout::width - PageStyle::right;
  layout.title = wrapped(drawing.title, characters(DrawingLayout::width - 2.0 * edge, title_character));
  layout.footnote = wrapped(footnote(drawing), characters(DrawingLayout::width - 2.0 * edge, footnote_character));
  layout.title_y = edge + line / 2.0;
  layout.top = layout.title_y + static_cast<double>(layout.title.size()) * line + 0.8;
  const auto texts = legend_texts(drawing);
  const auto middle = texts.begin() + static_cast<std::ptrdiff_t>(drawing.paths.size());
  for (const auto& [begin, end] : {std::pair(texts.begin(), middle), std::pair(middle, texts.end())}) {
    const LegendGrid grid = legend_grid({begin, end}, layout.top, DrawingLayout::width);
    layout.legend.insert(layout.legend.end(), grid.places.begin(), grid.places.end());
    layout.top = grid.end;
  }
  layout.bottom = layout.top + (layout.right - layout.left) * (drawing.window.y.high - drawing.window.y.low) /
                                   (drawing.window.x.high - drawing.window.x.low);
  layout.x_label_y = layout.bottom + 6.6;
  layout.footnote_y = layout.x_label_y + 4.6;
  layout.height =
      layout.footnote_y + edge + (static_cast<double>(layout.footnote.size()) - 0.5) * PageStyle::footnote_line_height;
  for (const DrawnPath& path : drawing.paths) layout.paths.push_back(visible(path, drawing.window));
  layout.texts = placed_texts(drawing, layout);
  return layout;
}

}  // namespace ridgeloc::results
