#include "results/figures/figure_layout.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "results/figures/figure_axes.hpp"
#include "results/schema/text.hpp"

namespace ridgeloc::results {
namespace {

constexpr double column_width = 85.0;
constexpr double single_panel_height = 50.0;
constexpr double stacked_panel_height = 38.0;
constexpr double smallest_panel_height = 15.0;
constexpr double smallest_panel_width = 20.0;
constexpr double between_panels = 3.0;
constexpr double between_columns = 2.0;
constexpr double x_axis_height = 6.6;  ///< from the lowest panel to the label of the axis
constexpr double footnote_distance = 4.6;

/// Puts entries below `y`; returns where the next line goes. Of groups and metrics a single one needs none. Texts that
/// are longer than the page is wide take several lines.
double place_legend(const std::vector<std::string>& texts, LegendEntry::Kind kind, double y, FigureLayout& layout) {
  if (texts.size() < 2 && kind != LegendEntry::Kind::Bound) return y;
  const double room = layout.page.width - 2.0 * PageStyle::edge - PageStyle::sample_length - PageStyle::sample_gap;
  const auto fits = [&](const std::string& text) { return display_width(text) <= characters(room, small_character); };
  if (std::ranges::all_of(texts, fits)) {
    const LegendGrid grid = legend_grid(texts, y, layout.page.width);
    for (std::size_t i = 0; i < texts.size(); ++i)
      layout.legend.push_back({grid.places[i].x, grid.places[i].y, kind, i, {texts[i]}});
    return grid.end;
  }
  // Lines that are full to the end may be of wide characters.
  const std::size_t most = characters(room, title_character);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    layout.legend.push_back({PageStyle::edge, y, kind, i, broken(texts[i], most)});
    y += static_cast<double>(layout.legend.back().lines.size()) * PageStyle::line_height;
  }
  return y;
}

std::size_t digits_of(const std::string& number) {
  return number.size() - static_cast<std::size_t>(std::ranges::count(number, '.'));
}

/// For the tick labels of the vertical axis; small shares on a logarithmic one are long.
double tick_width(bool log_y, const AxisRange& range) {
  constexpr std::size_t usual = 4;  // digits of "0.001", but for the narrow point
  constexpr double wide_digit = 2.0;
  std::size_t longest = usual;
  if (log_y) {
    for (const DecimalTick& tick : decimal_ticks(range)) {
      if (tick.digit == 1) longest = std::max(longest, digits_of(fmt::format("{:g}", tick.value)));
    }
  }
  return 11.0 + wide_digit * static_cast<double>(longest - usual);
}

/// Categories whose texts have no room beside each other get numbers. Returns what these stand for, in lines.
std::vector<std::string> numbered_categories(std::vector<FigureTick>& ticks, double axis, double text_width) {
  const double room = axis / static_cast<double>(ticks.size()) - small_character;
  const std::size_t most = characters(std::max(room, 0.0), small_character);
  if (std::ranges::all_of(ticks, [&](const FigureTick& tick) { return display_width(tick.label) <= most; })) return {};
  std::vector<std::string> key;
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const std::string number = fmt::format("({})", i + 1);
    for (std::string& line : broken(number + " " + ticks[i].label, characters(text_width, footnote_character)))
      key.push_back(std::move(line));
    ticks[i].label = number;
  }
  return key;
}

/// The ticks within the axis, those labels left out that would run into each other.
std::vector<FigureTick> spaced_ticks(const FigureData& data, const FigureLayout& layout,
                                     const std::vector<FigureTick>& all, double axis) {
  std::vector<FigureTick> ticks;
  double free_from = -std::numeric_limits<double>::infinity();
  for (FigureTick tick : all) {
    const double share = share_of_axis(layout.x, data.log_x, tick.position);
    if (share < 0.0 || share > 1.0) continue;
    const double half = 0.5 * small_character * static_cast<double>(display_width(tick.label));
    if (axis * share - half < free_from) {
      tick.label.clear();
    } else if (!tick.label.empty()) {
      free_from = axis * share + half + small_character;
    }
    ticks.push_back(std::move(tick));
  }
  return ticks;
}

std::string footnote(const FigureData& data, const FigureLayout& layout) {
  if (data.style != FigureStyle::Marks) return data.footnote;
  std::size_t omitted = 0;
  std::size_t outside = 0;
  bool any_log = false;
  bool any_bound = false;
  for (std::size_t i = 0; i < data.panels.size(); ++i) {
    const AxisRange& y = layout.panels[i].y;
    const bool log_y = data.scales[data.panels[i].scale].log;
    any_log = any_log || log_y;
    for (const FigureLine& line : data.panels[i].lines) {
      for (const FigurePoint& point : line.points) {
        const bool is_bound = log_y && point.never_seen;
        const double height = is_bound ? point.hi : point.y;
        if (!is_drawable(point, log_y)) {
          ++omitted;
        } else if (point.x < layout.x.low || point.x > layout.x.high || height < y.low || height > y.high) {
          ++outside;
        } else {
          any_bound = any_bound || is_bound;
        }
      }
    }
  }
  std::string text = data.footnote;
  if (any_bound) text += "; open triangles: not seen once, the upper 95 % bound of the rate";
  if (omitted > 0)
    text += fmt::format("; {} not shown: infinite{}", count_text(omitted, "point"), any_log ? " or not positive" : "");
  if (outside > 0) text += fmt::format("; {} outside of the axes", count_text(outside, "point"));
  return text;
}

/// The grid of panels: how many columns and rows, and the room of each.
struct Grid {
  std::size_t columns = 1;
  std::size_t rows = 1;
  double side = 0.0;  ///< left of a panel's axes
  double label_height = 0.0;
  double panel_width = 0.0;
  double panel_height = 0.0;
};

Grid grid_of(const FigureData& data) {
  Grid grid;
  const std::size_t wanted = data.view.columns == 0 ? data.scales.size() : data.view.columns;
  grid.columns = std::min(wanted, data.panels.size());
  grid.rows = (data.panels.size() + grid.columns - 1) / grid.columns;
  grid.panel_height = data.panels.size() > 1 ? stacked_panel_height : single_panel_height;
  const bool any_label = std::ranges::any_of(data.panels, [](const FigurePanel& p) { return !p.label.empty(); });
  grid.label_height = any_label ? PageStyle::line_height : 0.0;
  return grid;
}

/// Distance from a row of panels to the next.
double row_height(const Grid& grid) {
  return grid.label_height + grid.panel_height + between_panels;
}

/// From the top of the uppermost panels to the bottom of the lowest.
double grid_height(const Grid& grid) {
  return static_cast<double>(grid.rows) * row_height(grid) - between_panels;
}

/// The labels of the vertical axes, without their places: one for all panels that share a scale, else one for each.
std::vector<std::vector<std::string>> side_lines(const FigureData& data, const Grid& grid) {
  // The one label of all panels may reach beyond them by as much as the x axis below takes.
  const double room = data.scales.size() > 1 ? grid.panel_height : grid_height(grid) + 10.0;
  std::vector<std::vector<std::string>> lines;
  for (const FigureScale& scale : data.scales) lines.push_back(wrapped(scale.label, characters(room, small_character)));
  return lines;
}

void place_panels(const FigureData& data, const Grid& grid, double top, FigureLayout& layout) {
  for (std::size_t i = 0; i < data.panels.size(); ++i) {
    PanelLayout place;
    const auto column = static_cast<double>(i % grid.columns);
    const double y = top + static_cast<double>(i / grid.columns) * row_height(grid);
    place.label_y = y + 1.0;
    place.left = grid.side + column * (grid.panel_width + grid.side + between_columns);
    place.right = place.left + grid.panel_width;
    place.top = y + grid.label_height;
    place.bottom = place.top + grid.panel_height;
    place.y = vertical_range(data, data.panels[i].scale);
    place.is_lowest = i + grid.columns >= data.panels.size();
    layout.panels.push_back(place);
  }
}

void place_side_labels(const FigureData& data, const Grid& grid, const std::vector<std::vector<std::string>>& lines,
                       FigureLayout& layout) {
  const double inside = PageStyle::edge + PageStyle::line_height / 2.0;
  if (lines.size() == 1) {
    const double middle = (layout.panels.front().top + layout.panels.back().bottom) / 2.0;
    layout.y_labels.push_back({inside, middle, lines.front()});
    return;
  }
  for (std::size_t i = 0; i < data.panels.size(); ++i) {
    const PanelLayout& place = layout.panels[i];
    layout.y_labels.push_back(
        {place.left - grid.side + inside, (place.top + place.bottom) / 2.0, lines[data.panels[i].scale]});
  }
}

[[noreturn]] void refuse_size(const Page& size, double width, double height) {
  throw core::InputError(fmt::format(
      "--size {:g}x{:g}: this figure needs at least {:.0f}x{:.0f} mm; a larger one, other --columns or fewer panels",
      size.width, size.height, std::ceil(std::max(width, size.width)), std::ceil(std::max(height, size.height))));
}

}  // namespace

FigureLayout figure_layout(const FigureData& data) {
  FigureLayout layout;
  Grid grid = grid_of(data);
  layout.page.width = data.view.size ? data.view.size->width : column_width * static_cast<double>(grid.columns);
  const double text_width = layout.page.width - 2.0 * PageStyle::edge;
  layout.title = wrapped(data.title, characters(text_width, title_character));
  layout.conditions = wrapped(data.conditions, characters(text_width, small_character));

  double y = PageStyle::edge + PageStyle::line_height / 2.0;
  layout.title_y = y;
  y += static_cast<double>(layout.title.size()) * PageStyle::line_height;
  layout.conditions_y = y;
  y += static_cast<double>(layout.conditions.size()) * PageStyle::line_height;
  if (!layout.title.empty() || !layout.conditions.empty()) y += 0.8;
  layout.legend_title_y = y;
  if (data.groups.size() > 1) layout.legend_title = wrapped(data.group_title, characters(text_width, small_character));
  y += static_cast<double>(layout.legend_title.size()) * PageStyle::line_height;
  y = place_legend(data.groups, LegendEntry::Kind::Group, y, layout);
  y = place_legend(data.metrics, LegendEntry::Kind::Metric, y, layout);
  y = place_legend(data.bounds, LegendEntry::Kind::Bound, y, layout);

  const auto lines = side_lines(data, grid);
  for (std::size_t scale = 0; scale < data.scales.size(); ++scale) {
    const double ticks = tick_width(data.scales[scale].log, vertical_range(data, scale));
    grid.side = std::max(grid.side, ticks + PageStyle::line_height * static_cast<double>(lines[scale].size()));
  }
  const auto columns = static_cast<double>(grid.columns);
  const double gaps = columns * grid.side + (columns - 1.0) * between_columns + PageStyle::right;
  grid.panel_width = (layout.page.width - gaps) / columns;
  layout.x = horizontal_range(data);
  place_panels(data, grid, y, layout);
  std::vector<FigureTick> ticks = data.x_ticks;
  if (data.is_categorical) layout.key = numbered_categories(ticks, grid.panel_width, text_width);
  layout.ticks = spaced_ticks(data, layout, ticks, grid.panel_width);
  layout.footnote = wrapped(footnote(data, layout), characters(text_width, footnote_character));
  const double key_height =
      layout.key.empty() ? 0.0 : 0.8 + static_cast<double>(layout.key.size()) * PageStyle::footnote_line_height;
  layout.x_label_x = (layout.panels.front().left + layout.page.width - PageStyle::right) / 2.0;
  layout.x_label = wrapped(data.x_label, characters(2.0 * (layout.page.width - layout.x_label_x), small_character));
  const double x_label_height = PageStyle::line_height * (static_cast<double>(layout.x_label.size()) - 1.0);
  const double below = x_axis_height + x_label_height + footnote_distance + key_height + PageStyle::edge +
                       (static_cast<double>(layout.footnote.size()) - 0.5) * PageStyle::footnote_line_height;
  if (data.view.size) {
    const auto rows = static_cast<double>(grid.rows);
    const double fixed = y + below + grid_height(grid) - rows * grid.panel_height;
    grid.panel_height = (data.view.size->height - fixed) / rows;
    if (grid.panel_width < smallest_panel_width || grid.panel_height < smallest_panel_height)
      refuse_size(*data.view.size, gaps + columns * smallest_panel_width, fixed + rows * smallest_panel_height);
    layout.panels.clear();
    place_panels(data, grid, y, layout);
  }
  y += grid_height(grid);
  place_side_labels(data, grid, lines, layout);
  layout.x_label_y = y + x_axis_height;
  layout.key_y = layout.x_label_y + x_label_height + footnote_distance;
  layout.footnote_y = layout.key_y + key_height;
  layout.page.height = y + below;
  return layout;
}

std::vector<std::vector<FigurePoint>> drawn_bound(const FigureData& data, const FigureLayout& layout,
                                                  const FigureBound& bound, bool log_y) {
  std::vector<std::vector<FigurePoint>> stretches;
  for (const FigurePoint& point : bound.points) {
    if (!is_drawable(point, log_y)) continue;
    if (stretches.empty() || data.is_categorical) stretches.emplace_back();
    stretches.back().push_back(point);
  }
  constexpr double reach = 0.02;
  const double share = data.is_categorical ? 0.35 / static_cast<double>(data.x_ticks.size()) : reach;
  for (std::vector<FigurePoint>& stretch : stretches) {
    if (stretch.size() > 1) continue;
    const auto moved = [&](double by) {
      FigurePoint point = stretch.front();
      point.x = value_on_axis(layout.x, data.log_x, share_of_axis(layout.x, data.log_x, point.x) + by);
      return point;
    };
    stretch = {moved(-share), moved(share)};
  }
  return stretches;
}

}  // namespace ridgeloc::results
