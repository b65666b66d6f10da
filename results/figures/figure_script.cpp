#include "results/figures/figure_script.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>

#include "results/figures/figure_axes.hpp"
#include "results/figures/figure_bars.hpp"
#include "results/figures/figure_layout.hpp"
#include "results/pictures/gnuplot.hpp"
#include "results/pictures/page_script.hpp"

namespace ridgeloc::results {
namespace {

using Layout = FigureLayout;

/// Of bands around lines, and of those of bounds, which lie behind them.
constexpr double band_opacity = 0.2;
constexpr double bound_band_opacity = 0.12;

struct Style {
  const char* colour = "#444444";
  int filled_mark = filled_marks.front();
  bool open = false;
  const char* dash = dashes.front();
};

/// Open or filled marks and the dash tell the metrics apart.
Style with_metric(Style style, std::size_t metric) {
  style.open = metric % 2 == 1;
  style.dash = dashes[metric % dashes.size()];
  return style;
}

Style line_style(const FigureData& data, std::size_t group, std::size_t metric) {
  // Marks move on by one when the colours begin again.
  const std::size_t mark = group + group / colours.size();
  const Style style = {colours[group % colours.size()], filled_marks[mark % filled_marks.size()], false,
                       dashes[group % dashes.size()]};
  return data.metrics.size() > 1 ? with_metric(style, metric) : style;
}

/// Grey where it belongs to several groups; the dash tells such ones apart.
Style bound_style(const std::optional<std::size_t>& group, std::size_t entry) {
  Style style;
  if (group) style.colour = colours[*group % colours.size()];
  style.dash = bound_dashes[entry % bound_dashes.size()];
  return style;
}

/// A line, given with its plotting style, and its marks if the figure has any. Under an open mark the line is covered.
/// Nothing joins the marks of categories.
std::string drawn_line(const FigureData& data, const std::string& line, const std::string& places, const Style& style) {
  std::string elements;
  if (!data.is_categorical) elements = fmt::format("{} lw 1.2 lc rgb '{}' dt {}", line, style.colour, style.dash);
  if (data.style != FigureStyle::Marks) return elements;
  const auto marks = [&](int mark, double size, const char* colour) {
    append(elements, next_element,
           fmt::format("{} using 1:2 with points pt {} ps {} lw 1 lc rgb '{}'", places, mark, size, colour));
  };
  if (style.open) marks(style.filled_mark, 0.4, "white");
  marks(style.filled_mark - (style.open ? 1 : 0), 0.5, style.colour);
  return elements;
}

std::string drawn_bound_line(const std::string& line, const Style& style) {
  return fmt::format("{} lw 1.1 lc rgb '{}' dt {}", line, style.colour, style.dash);
}

/// All that is written on the page outside of the panels' axes.
std::string lettering(const FigureData& data, const Layout& layout) {
  std::string script;
  const auto lines = [&](const std::vector<std::string>& texts, double x, double y, double height,
                         const char* options) {
    for (const std::string& line : texts) {
      script += page_text(layout.page, x, y, line, options);
      y += height;
    }
  };
  const double middle = layout.page.width / 2.0;
  lines(layout.title, middle, layout.title_y, PageStyle::line_height, "center font ',8.5'");
  lines(layout.conditions, middle, layout.conditions_y, PageStyle::line_height, "center font ',7'");
  lines(layout.key, PageStyle::edge, layout.key_y, PageStyle::footnote_line_height, "left font ',5.5'");
  lines(layout.footnote, PageStyle::edge, layout.footnote_y, PageStyle::footnote_line_height,
        "left font ',5.5' tc rgb '#444444'");
  lines(layout.x_label, layout.x_label_x, layout.x_label_y, PageStyle::line_height, "center font ',7'");
  for (const SideLabel& label : layout.y_labels) {
    double x = label.x;
    for (const std::string& line : label.lines) {
      script += page_text(layout.page, x, label.y, line, "center rotate by 90 font ',7'");
      x += PageStyle::line_height;
    }
  }
  for (std::size_t i = 0; i < layout.panels.size(); ++i) {
    if (data.panels[i].label.empty()) continue;
    script += page_text(layout.page, layout.panels[i].left, layout.panels[i].label_y, data.panels[i].label,
                        "left font ',7.5'");
  }
  lines(layout.legend_title, middle, layout.legend_title_y, PageStyle::line_height, "center font ',7'");
  for (const LegendEntry& entry : layout.legend) {
    lines(entry.lines, entry.x + PageStyle::sample_length + PageStyle::sample_gap, entry.y, PageStyle::line_height,
          "left font ',7'");
  }
  return script;
}

/// Plots the legend's samples over the whole page, in coordinates of millimetres; the lettering comes with
/// it.
std::string draw_page(const FigureData& data, const Layout& layout) {
  std::string script = lettering(data, layout) + margins(layout.page, 0.0, layout.page.width, 0.0, layout.page.height) +
                       "unset border\nunset tics\n" + axis_ranges({0.0, layout.page.width}, {layout.page.height, 0.0});
  std::string elements;
  for (std::size_t i = 0; i < layout.legend.size(); ++i) {
    const LegendEntry& entry = layout.legend[i];
    const std::string name = fmt::format("$sample{}", i);
    script += fmt::format("{0} << EOD\n{1} {3} {4}\n\n\n{2} {3}\nEOD\n", name, entry.x,
                          entry.x + PageStyle::sample_length / 2.0, entry.y, PageStyle::sample_length);
    const std::string line = name + " index 0 using 1:2:3:(0) with vectors nohead";
    if (entry.kind == LegendEntry::Kind::Bound) {
      append(elements, next_element, drawn_bound_line(line, bound_style(std::nullopt, entry.index)));
      continue;
    }
    const Style style =
        entry.kind == LegendEntry::Kind::Metric ? with_metric(Style{}, entry.index) : line_style(data, entry.index, 0);
    append(elements, next_element, drawn_line(data, line, name + " index 1", style));
  }
  return script + plot_command(elements) + "unset label\n";
}

/// Ticks of a logarithmic axis: labelled at 1, 2 and 5 times the powers of ten where the axis is short, else at the
/// powers alone, and on a very long one at so few of these that their labels have room.
std::string log_y_ticks(const AxisRange& range) {
  constexpr double most_labels = 12.0;
  const double powers = std::log10(range.high) - std::log10(range.low);
  const bool is_short = powers < std::log10(300.0);
  const int every = std::max(1, static_cast<int>(std::ceil(powers / most_labels)));
  std::string list;
  for (const DecimalTick& tick : decimal_ticks(range)) {
    if (every > 1 && tick.digit > 1) continue;
    const bool is_labelled_power = tick.digit == 1 && tick.power % every == 0;
    const bool major = is_labelled_power || (is_short && (tick.digit == 2 || tick.digit == 5));
    append(list, ", ",
           fmt::format("'{}' {} {}", major ? fmt::format("{:g}", tick.value) : "", tick.value, major ? 0 : 1));
  }
  return fmt::format("set ytics nomirror ({})\n", list);
}

std::string x_ticks(const Layout& layout, bool labelled) {
  std::string list;
  for (const FigureTick& tick : layout.ticks) {
    append(list, ", ",
           fmt::format("{} {} {}", gnuplot_tick_label(labelled ? tick.label : ""), tick.position,
                       tick.label.empty() ? 1 : 0));
  }
  return fmt::format("set xtics nomirror offset 0,0.4 ({})\n", list);
}

/// What the axes of all panels share.
std::string all_axes(const FigureData& data) {
  std::string script =
      "set border 3 lw 0.7\n"
      "set tics nomirror out scale 0.5,0.3 font ',7'\n"
      "set xtics nomirror\nset ytics nomirror\n"
      "set grid xtics ytics back lt 1 lc rgb '#dcdcdc' lw 0.5\n"
      "set format y '%g'\n";
  if (data.log_x) script += "set logscale x\n";
  return script;
}

std::string panel_axes(const Layout& layout, const PanelLayout& place, bool log_y) {
  const std::string script = margins(layout.page, place.left, place.right, place.top, place.bottom) +
                             axis_ranges(layout.x, place.y) + x_ticks(layout, place.is_lowest);
  if (log_y) return script + "set logscale y\n" + log_y_ticks(place.y);
  return script + "unset logscale y\nset ytics nomirror autofreq\n";
}

/// A number of a data block; gnuplot leaves out what is not one.
std::string plotted(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : "NaN";
}

/// x, y, lower and upper end of the bar or the band within the axis, whether it is trusted, x of the bar, and the upper
/// bound of what was never seen.
std::string point_row(const AxisRange& axis, const FigurePoint& point, double bar_x, double bound) {
  const double lo = std::max(point.lo, axis.low);
  const double hi = std::min(point.hi, axis.high);
  const bool has_bar = lo <= hi;
  return fmt::format("{} {} {} {} {} {} {}\n", point.x, plotted(point.y), has_bar ? plotted(lo) : "NaN",
                     has_bar ? plotted(hi) : "NaN", point.trusted ? 1 : 0, bar_x, plotted(bound));
}

/// A data block of the line's points.
std::string data_block(const std::string& name, const FigureData& data, const PanelLayout& place, bool log_y,
                       const FigureLine& line, const std::vector<double>& bar_places) {
  constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();
  std::string block = name + " << EOD\n";
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    FigurePoint point = line.points[i];
    double bound = nowhere;
    if (data.style != FigureStyle::Marks) {
      // A line without marks goes along the edge where it has no place.
      if (log_y) point.y = std::max(point.y, place.y.low);
    } else if (log_y && point.never_seen) {
      bound = point.hi;
      point.y = point.lo = point.hi = nowhere;
    } else if (!is_drawable(point, log_y)) {
      point.y = point.lo = point.hi = nowhere;
    }
    block += point_row(place.y, point, bar_places[i], bound);
  }
  return block + "EOD\n";
}

/// The error bars of a line; a dotted one is not trusted.
std::string bars(const Page& page, const std::string& name, const Style& style) {
  constexpr double cap = 0.68;  // mm, to either side
  // A bar is a vector from its lower to its upper end, with heads of 90 degrees for caps: gnuplot's own error
  // bars leave a gap around the mark.
  return fmt::format(
      "{0} using 6:($5 == 1 ? $3 : NaN):(0):($4 - $3) with vectors heads size screen {3:.5f},90 lw 0.9 lc rgb "
      "'{1}'{2}"
      "{0} using 6:($5 == 0 ? $3 : NaN):(0):($4 - $3) with vectors nohead lw 1.2 lc rgb '{1}' dt (2,3)",
      name, style.colour, next_element, cap / page.width);
}

/// Where the line may lie, a shade of its colour.
std::string band(const std::string& name, const Style& style, double opacity) {
  return fmt::format("{} using 1:3:4 with filledcurves lc rgb '{}' fs transparent solid {} noborder", name,
                     style.colour, opacity);
}

/// The upper bounds of what a line has never seen.
std::string upper_bounds(const std::string& name, const Style& style) {
  return fmt::format("{} using 1:7 with points pt {} ps 0.6 lw 1 lc rgb '{}'", name, bound_mark, style.colour);
}

std::string draw_panel(const FigureData& data, const Layout& layout, std::size_t index) {
  const PanelLayout& place = layout.panels[index];
  const bool log_y = data.scales[data.panels[index].scale].log;
  std::string script = panel_axes(layout, place, log_y);
  std::string bands;  // behind all lines
  std::string elements;
  for (std::size_t i = 0; i < data.panels[index].bounds.size(); ++i) {
    const FigureBound& bound = data.panels[index].bounds[i];
    const auto stretches = drawn_bound(data, layout, bound, log_y);
    if (stretches.empty()) continue;
    const std::string name = fmt::format("$panel{}_bound{}", index, i);
    const Style style = bound_style(bound.group, bound.entry);
    script += name + " << EOD\n";
    // An empty line ends a stretch.
    for (const std::vector<FigurePoint>& stretch : stretches) {
      for (const FigurePoint& point : stretch) script += point_row(place.y, point, point.x, point.hi);
      script += "\n";
    }
    script += "EOD\n";
    if (bound.has_band) append(bands, next_element, band(name, style, bound_band_opacity));
    append(elements, next_element, drawn_bound_line(name + " using 1:2 with lines", style));
  }
  const auto places = bar_places(data, layout, index);
  for (std::size_t i = 0; i < data.panels[index].lines.size(); ++i) {
    const FigureLine& line = data.panels[index].lines[i];
    const bool any = std::any_of(line.points.begin(), line.points.end(),
                                 [&](const FigurePoint& point) { return is_drawable(point, log_y); });
    if (!any) continue;
    const std::string name = fmt::format("$panel{}_group{}_metric{}", index, line.group, line.metric);
    const Style style = line_style(data, line.group, line.metric);
    script += data_block(name, data, place, log_y, line, places[i]);
    if (data.style == FigureStyle::Marks) append(elements, next_element, bars(layout.page, name, style));
    if (data.style == FigureStyle::Bands) append(bands, next_element, band(name, style, band_opacity));
    append(elements, next_element, drawn_line(data, name + " using 1:2 with lines", name, style));
    const auto is_bound = [&](const FigurePoint& point) { return log_y && point.never_seen; };
    if (std::ranges::any_of(line.points, is_bound)) append(elements, next_element, upper_bounds(name, style));
  }
  if (!bands.empty()) elements = bands + std::string(next_element) + elements;
  return script + plot_command(elements);
}

}  // namespace

std::string figure_script(const FigureData& data, FigureFormat format, const std::filesystem::path& output) {
  const Layout layout = figure_layout(data);
  std::string script = fmt::format("set encoding utf8\nset terminal {} noenhanced\nset output {}\n",
                                   terminal(format, layout.page), gnuplot_string(output.string()));
  script += "unset key\nset multiplot\n" + draw_page(data, layout) + all_axes(data);
  for (std::size_t i = 0; i < data.panels.size(); ++i) script += draw_panel(data, layout, i);
  return script + "unset multiplot\nunset output\n";
}

}  // namespace ridgeloc::results
