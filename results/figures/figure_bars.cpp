#include "results/figures/figure_bars.hpp"

#include <algorithm>
#include <map>

#include "results/figures/figure_axes.hpp"

namespace ridgeloc::results {
namespace {

// As they are drawn, in millimetres.
constexpr double mark_width = 1.3;
constexpr double line_width = 0.32;

struct Bar {
  std::size_t line = 0;
  std::size_t point = 0;
  double low = 0.0;  ///< ends in millimetres above the lower edge of the panel
  double high = 0.0;
};

/// Distances of neighbours that overlap, so many of them at one place.
double step_of(std::size_t bars) {
  constexpr double less_than_a_line = 0.8 * line_width;
  return bars < 2 ? 0.0 : std::min(less_than_a_line, mark_width / static_cast<double>(bars - 1));
}

}  // namespace

std::vector<std::vector<double>> bar_places(const FigureData& data, const FigureLayout& layout, std::size_t panel) {
  const PanelLayout& place = layout.panels[panel];
  const bool log_y = data.scales[data.panels[panel].scale].log;
  const auto height_of = [&](double y) {
    const double inside = std::clamp(y, place.y.low, place.y.high);
    return share_of_axis(place.y, log_y, inside) * (place.bottom - place.top);
  };
  std::vector<std::vector<double>> places;
  std::map<double, std::vector<Bar>> bars;  // by x
  const std::vector<FigureLine>& lines = data.panels[panel].lines;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    places.emplace_back();
    for (std::size_t j = 0; j < lines[i].points.size(); ++j) {
      const FigurePoint& point = lines[i].points[j];
      places.back().push_back(point.x);
      if (!is_drawable(point, log_y)) continue;
      const Bar bar{i, j, height_of(point.lo), height_of(point.hi)};
      if (bar.high - bar.low > mark_width) bars[point.x].push_back(bar);
    }
  }

  const double width = place.right - place.left;
  for (auto& [x, at_x] : bars) {
    std::ranges::sort(at_x, {}, &Bar::low);
    for (auto first = at_x.begin(); first != at_x.end();) {
      auto last = first;
      double end = first->high;
      while (last != at_x.end() && last->low <= end) end = std::max(end, (last++)->high);
      std::sort(first, last, [](const Bar& a, const Bar& b) { return a.line < b.line; });
      const auto count = static_cast<std::size_t>(last - first);
      double offset = -0.5 * step_of(count) * static_cast<double>(count - 1);
      for (; first != last; ++first, offset += step_of(count)) {
        const double share = share_of_axis(layout.x, data.log_x, x) + offset / width;
        if (offset != 0.0) places[first->line][first->point] = value_on_axis(layout.x, data.log_x, share);
      }
    }
  }
  return places;
}

}  // namespace ridgeloc::results
