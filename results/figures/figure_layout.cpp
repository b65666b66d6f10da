#include "results/figures/figure_layout.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "results/schema/text.hpp"

namespace ridgeloc::results {
namespace {

constexpr double single_panel_height = 50.0;
constexpr double stacked_panel_height = 38.0;
constexpr double between_panels = 3.0;

/// Puts entries below `y`; returns where the next line goes. Of groups and metrics a single one needs none.
double place_legend(const std::vector<std::string>& texts, LegendEntry::Kind kind, double y, FigureLayout& layout) {
  if (texts.size() < 2 && kind != LegendEntry::Kind::Bound) return y;
  const LegendGrid grid = legend_grid(texts, y, FigureLayout::width);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    layout.legend.push_back({grid.places[i].x, grid.places[i].y, kind, i});
  }
  return grid.end;
}

double place_panels(const FigureData& data, double y, FigureLayout& layout) {
  const bool several = data.panels.size() > 1;
  for (const FigurePanel& panel : data.panels) {
    PanelLayout place;
    if (!panel.label.empty()) {
      place.label_y = y + 1.0;
      y += PageStyle::line_height;
    }
    place.top = y;
    place.bottom = y + (several ? stacked_panel_height : single_panel_height);
    y = place.bottom + between_panels;
    layout.panels.push_back(place);
  }
  return y - between_panels;
}

std::size_t line_count(const FigureData& data) {
  return data.groups.size() * data.metrics.size();
}

/// Sets the x axis and the sideways step between lines.
void place_x(const FigureData& data, FigureLayout& layout) {
  const auto scaled = [&](const FigureTick& tick) { return data.log_x ? std::log10(tick.position) : tick.position; };
  const double low = scaled(data.x_ticks.front());
  const double high = scaled(data.x_ticks.back());
  const double span = high > low ? high - low : 1.0;
  double spacing = span;
  for (std::size_t i = 1; i < data.x_ticks.size(); ++i) {
    spacing = std::min(spacing, scaled(data.x_ticks[i]) - scaled(data.x_ticks[i - 1]));
  }
  // Marks are about 2 % of the axis wide; all lines together keep within 0.6 of the distance of two values.
  const double lines = static_cast<double>(line_count(data));
  layout.dodge = data.style == FigureStyle::Marks ? std::min(0.02 * span, 0.6 * spacing / lines) : 0.0;
  const double padding = 0.04 * span + 0.5 * layout.dodge * (lines - 1.0);
  layout.x = {low - padding, high + padding};
  if (data.log_x) layout.x = {std::pow(10.0, layout.x.low), std::pow(10.0, layout.x.high)};
}

AxisRange linear_range(AxisRange range) {
  // Zero belongs to the axis where it is near: heights can then be compared as they look.
  if (range.low > 0.0 && range.low < 0.4 * range.high) range.low = 0.0;
  const double span = range.high - range.low;
  const double padding = span > 0.0 ? 0.06 * span : std::max(0.1 * std::abs(range.high), 1e-3);
  return {range.low == 0.0 ? 0.0 : range.low - padding, range.high + padding};
}

AxisRange y_range(const FigureData& data) {
  AxisRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const FigurePanel& panel : data.panels) {
    for (const FigureLine& line : panel.lines) {
      for (const FigurePoint& point : line.points) {
        if (!is_drawable(point, data.log_y)) continue;
        // On a logarithmic axis a bar that reaches to zero would stretch the axis without end.
        const double lo = data.log_y ? std::max(point.lo, point.y / 3.0) : point.lo;
        range.low = std::min({range.low, point.y, std::isfinite(lo) ? lo : point.y});
        range.high = std::max({range.high, point.y, std::isfinite(point.hi) ? point.hi : point.y});
      }
    }
    for (const FigureBound& bound : panel.bounds) {
      for (const FigurePoint& point : bound.points) {
        if (!is_drawable(point, data.log_y)) continue;
        const bool has_band = bound.has_band && is_drawable({point.x, point.lo}, data.log_y);
        range.low = std::min(range.low, has_band ? point.lo : point.y);
        range.high = std::max(range.high, bound.has_band && std::isfinite(point.hi) ? point.hi : point.y);
      }
    }
  }
  if (range.low > range.high) return data.log_y ? AxisRange{0.1, 1.0} : AxisRange{};
  if (!data.log_y) return linear_range(range);
  const double factor = std::max(std::pow(range.high / range.low, 0.06), 1.1);
  return {range.low / factor, range.high * factor};
}

std::size_t digits_of(const std::string& number) {
  return number.size() - static_cast<std::size_t>(std::ranges::count(number, '.'));
}

/// For the labels of the vertical axis and its ticks; small shares on a logarithmic one are long.
double label_width(const FigureData& data, const AxisRange& range) {
  constexpr std::size_t usual = 4;  // digits of "0.001", but for the narrow point
  constexpr double wide_digit = 2.0;
  std::size_t longest = usual;
  if (data.log_y) {
    for (int power = static_cast<int>(std::ceil(std::log10(range.low))); std::pow(10.0, power) <= range.high; ++power)
      longest = std::max(longest, digits_of(fmt::format("{:g}", std::stod(fmt::format("1e{}", power)))));
  }
  return 11.0 + wide_digit * static_cast<double>(longest - usual);
}

/// Share of the axis, in [0, 1].
double share(const AxisRange& range, bool logarithmic, double value) {
  if (logarithmic) return std::log(value / range.low) / std::log(range.high / range.low);
  return (value - range.low) / (range.high - range.low);
}

std::vector<FigureTick> spaced_ticks(const FigureData& data, const FigureLayout& layout) {
  std::vector<FigureTick> ticks = data.x_ticks;
  const double axis = FigureLayout::width - layout.left - PageStyle::right;
  double free_from = -std::numeric_limits<double>::infinity();
  for (FigureTick& tick : ticks) {
    if (tick.label.empty()) continue;
    const double centre = axis * share(layout.x, data.log_x, tick.position);
    const double half = 0.5 * small_character * static_cast<double>(display_width(tick.label));
    if (centre - half < free_from) {
      tick.label.clear();
    } else {
      free_from = centre + half + small_character;
    }
  }
  return ticks;
}

std::string footnote(const FigureData& data) {
  if (data.style != FigureStyle::Marks) return data.footnote;
  std::size_t omitted = 0;
  for (const FigurePanel& panel : data.panels) {
    for (const FigureLine& line : panel.lines) {
      for (const FigurePoint& point : line.points) omitted += is_drawable(point, data.log_y) ? 0 : 1;
    }
  }
  if (omitted == 0) return data.footnote;
  return fmt::format("{}; {} {} not shown: infinite{}", data.footnote, omitted, omitted == 1 ? "point" : "points",
                     data.log_y ? " or not positive" : "");
}

}  // namespace

FigureLayout figure_layout(const FigureData& data) {
  FigureLayout layout;
  const double text_width = FigureLayout::width - 2.0 * PageStyle::edge;
  layout.title = wrapped(data.title, characters(text_width, title_character));
  layout.conditions = wrapped(data.conditions, characters(text_width, small_character));
  const std::size_t panels = data.panels.size();
  const double label_room = panels > 1 ? static_cast<double>(panels) * stacked_panel_height : single_panel_height;
  // The label may reach beyond the panels by as much as the x axis below them takes.
  layout.y_label = wrapped(data.y_label, characters(label_room + 10.0, small_character));
  layout.y = y_range(data);
  layout.left = label_width(data, layout.y) + PageStyle::line_height * static_cast<double>(layout.y_label.size());
  layout.footnote = wrapped(footnote(data), characters(text_width, footnote_character));

  double y = PageStyle::edge + PageStyle::line_height / 2.0;
  layout.title_y = y;
  y += static_cast<double>(layout.title.size()) * PageStyle::line_height;
  layout.conditions_y = y;
  y += static_cast<double>(layout.conditions.size()) * PageStyle::line_height;
  if (!layout.title.empty() || !layout.conditions.empty()) y += 0.8;
  layout.legend_title_y = y;
  if (data.groups.size() > 1 && !data.group_title.empty()) y += PageStyle::line_height;
  y = place_legend(data.groups, LegendEntry::Kind::Group, y, layout);
  y = place_legend(data.metrics, LegendEntry::Kind::Metric, y, layout);
  y = place_legend(data.bounds, LegendEntry::Kind::Bound, y, layout);
  y = place_panels(data, y, layout);
  layout.x_label_y = y + 6.6;
  layout.footnote_y = layout.x_label_y + 4.6;
  layout.height = layout.footnote_y + PageStyle::edge +
                  (static_cast<double>(layout.footnote.size()) - 0.5) * PageStyle::footnote_line_height;

  place_x(data, layout);
  layout.ticks = spaced_ticks(data, layout);
  return layout;
}

bool is_drawable(const FigurePoint& point, bool log_y) {
  return std::isfinite(point.y) && (!log_y || point.y > 0.0);
}

double dodged(const FigureData& data, const FigureLayout& layout, const FigureLine& line, double x) {
  const double index = static_cast<double>(line.metric + line.group * data.metrics.size());
  const double offset = layout.dodge * (index - 0.5 * static_cast<double>(line_count(data) - 1));
  return data.log_x ? x * std::pow(10.0, offset) : x + offset;
}

std::vector<FigurePoint> drawn_bound(const FigureData& data, const FigureLayout& layout, const FigureBound& bound) {
  std::vector<FigurePoint> points;
  for (const FigurePoint& point : bound.points)
    if (is_drawable(point, data.log_y)) points.push_back(point);
  if (points.size() != 1) return points;
  constexpr double reach = 0.02;
  const auto moved = [&](double share) {
    FigurePoint point = points.front();
    point.x = data.log_x ? point.x * std::pow(layout.x.high / layout.x.low, share)
                         : point.x + share * (layout.x.high - layout.x.low);
    return point;
  };
  return {moved(-reach), moved(reach)};
}

}  // namespace ridgeloc::results
