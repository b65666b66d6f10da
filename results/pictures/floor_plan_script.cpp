#include "results/pictures/floor_plan_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "results/pictures/gnuplot.hpp"
#include "results/pictures/picture_file.hpp"

namespace ridgeloc::results {

namespace {

constexpr double page_width = 180.0;  // two columns of a journal
constexpr double gap = 4.0;           // between panels
constexpr double axis_left = 11.0;    // for the tick labels and the axis' label
constexpr double axis_bottom = 8.0;

bool is_tile(PlanMark mark) {
  return mark == PlanMark::GoodTile || mark == PlanMark::WrongTile || mark == PlanMark::OutsideTile ||
         mark == PlanMark::LostTile;
}

/// Everything after the data in a plot element.
std::string style_of(PlanMark mark) {
  const auto points = [](int type, double size, const char* colour, double line = 1.0) {
    return fmt::format("with points pt {} ps {} lw {} lc rgb '{}'", type, size, line, colour);
  };
  const auto tiles = [](const char* colour) {
    return fmt::format("with boxxyerror fs solid 1 noborder lc rgb '{}'", colour);
  };
  switch (mark) {
    case PlanMark::Object:
      return points(7, 0.35, "#999999");
    case PlanMark::Used:
      return points(4, 0.7, "#555555");
    case PlanMark::Filled:
      return points(7, 0.7, "#000000");
    case PlanMark::Hollow:
      return points(6, 0.7, "#000000");
    case PlanMark::Cross:
      return points(2, 0.6, colours[1], 1.4);
    case PlanMark::Mean:
      return points(13, 1.0, colours[0]);
    case PlanMark::Star:
      return points(3, 1.2, "#000000", 1.6);
    case PlanMark::GoodTile:
      return tiles(colours[0]);
    case PlanMark::WrongTile:
      return tiles("#f0c060");
    case PlanMark::OutsideTile:
      return tiles("#c8c8c8");
    case PlanMark::LostTile:
      return tiles("#eeeeee");
  }
  return {};
}

struct PlanLayout {
  std::size_t columns = 1;
  std::size_t rows = 1;
  double panel_width = 0.0;
  double panel_height = 0.0;
  std::vector<std::string> title;
  std::vector<std::string> footnote;
  double panels_top = 0.0;
  LegendGrid legend;
  double footnote_y = 0.0;
  double height = 0.0;

  double left(std::size_t i) const {
    return axis_left + static_cast<double>(i % columns) * (panel_width + axis_left + gap);
  }
  double top(std::size_t i) const {
    return panels_top + static_cast<double>(i / columns) * (panel_height + axis_bottom + PageStyle::line_height) +
           PageStyle::line_height;
  }
};

PlanLayout layout_of(const FloorPlan& plan) {
  PlanLayout layout;
  layout.columns = std::min<std::size_t>(plan.panels.size(), 2);
  layout.rows = (plan.panels.size() + layout.columns - 1) / layout.columns;
  const auto columns = static_cast<double>(layout.columns);
  layout.panel_width = (page_width - PageStyle::right - columns * axis_left - (columns - 1.0) * gap) / columns;
  layout.panel_height =
      layout.panel_width * (plan.window.y.high - plan.window.y.low) / (plan.window.x.high - plan.window.x.low);
  const double text_width = page_width - 2.0 * PageStyle::edge;
  layout.title = wrapped(plan.title, characters(text_width, title_character));
  layout.footnote = wrapped(plan.footnote, characters(text_width, footnote_character));
  double y = PageStyle::edge + PageStyle::line_height / 2.0;
  layout.panels_top = y + static_cast<double>(layout.title.size()) * PageStyle::line_height;
  y = layout.top(layout.rows * layout.columns - 1) + layout.panel_height + axis_bottom + PageStyle::line_height;
  std::vector<std::string> texts;
  for (const PlanKey& key : plan.keys) texts.push_back(key.text);
  layout.legend = legend_grid(texts, y, page_width);
  layout.footnote_y = layout.legend.end + PageStyle::line_height / 2.0;
  layout.height = layout.footnote_y + static_cast<double>(layout.footnote.size()) * PageStyle::footnote_line_height +
                  PageStyle::edge;
  return layout;
}

/// A data block and the element that plots it.
std::string add_places(const std::string& name, PlanMark mark, const std::vector<DrawnPoint>& points, double tile,
                       std::string& elements) {
  std::string script = name + " << EOD\n";
  for (const DrawnPoint& p : points) {
    script += is_tile(mark) ? fmt::format("{} {} {} {}\n", p.x, p.y, 0.5 * tile, 0.5 * tile)
                            : fmt::format("{} {}\n", p.x, p.y);
  }
  append(elements, next_element,
         fmt::format("{} using {} {}", name, is_tile(mark) ? "1:2:3:4" : "1:2", style_of(mark)));
  return script + "EOD\n";
}

std::string draw_panel(const FloorPlan& plan, const PlanLayout& layout, const Page& page, std::size_t i) {
  const double left = layout.left(i);
  const double top = layout.top(i);
  // Walls may run through the window with both ends outside.
  std::string script = margins(page, left, left + layout.panel_width, top, top + layout.panel_height) +
                       "set clip two\nset border 3 lw 0.7\nset tics nomirror out scale 0.5,0.3 font ',7'\n"
                       "set xtics nomirror offset 0,0.4\nset ytics nomirror\n" +
                       axis_ranges(plan.window.x, plan.window.y);
  script += page_text(page, left + layout.panel_width / 2.0, top - PageStyle::line_height / 2.0, plan.panels[i].title,
                      "center font ',7'");
  std::string elements;
  const auto add = [&](bool tiles) {
    for (std::size_t k = 0; k < plan.panels[i].places.size(); ++k) {
      const PlanPlaces& places = plan.panels[i].places[k];
      if (places.points.empty() || is_tile(places.mark) != tiles) continue;
      script += add_places(fmt::format("$places{}_{}", i, k), places.mark, places.points, plan.tile, elements);
    }
  };
  add(true);
  append(elements, next_element, "$outlines using 1:2 with lines lw 0.8 lc rgb '#777777'");
  add(false);
  return script + plot_command(elements) + "unset label\n";
}

/// Title, legend, axis labels and footnote, in coordinates of millimetres.
std::string plan_page(const FloorPlan& plan, const PlanLayout& layout, const Page& page) {
  std::string script;
  double y = PageStyle::edge + PageStyle::line_height / 2.0;
  for (const std::string& line : layout.title) {
    script += page_text(page, page_width / 2.0, y, line, "center font ',8.5'");
    y += PageStyle::line_height;
  }
  y = layout.footnote_y;
  for (const std::string& line : layout.footnote) {
    script += page_text(page, PageStyle::edge, y, line, "left font ',5.5' tc rgb '#444444'");
    y += PageStyle::footnote_line_height;
  }
  const std::size_t last_row = (layout.rows - 1) * layout.columns;
  for (std::size_t c = 0; c < layout.columns; ++c) {
    script +=
        page_text(page, layout.left(c) + layout.panel_width / 2.0,
                  layout.top(last_row + c) + layout.panel_height + axis_bottom - 1.5, "x [m]", "center font ',7'");
  }
  for (std::size_t r = 0; r < layout.rows; ++r) {
    script += page_text(page, PageStyle::edge, layout.top(r * layout.columns) + layout.panel_height / 2.0, "y [m]",
                        "center rotate by 90 font ',7'");
  }
  script += margins(page, 0.0, page_width, 0.0, layout.height) + "unset border\nunset tics\n" +
            axis_ranges({0.0, page_width}, {layout.height, 0.0});
  std::string elements;
  for (std::size_t i = 0; i < plan.keys.size(); ++i) {
    const auto [x, key_y] = layout.legend.places[i];
    script += page_text(page, x + PageStyle::sample_length / 2.0 + 1.0 + PageStyle::sample_gap, key_y,
                        plan.keys[i].text, "left font ',7'");
    constexpr double sample_mm = 2.2;
    script += add_places(fmt::format("$key{}", i), plan.keys[i].mark,
                         {{x + PageStyle::sample_length / 2.0 - 1.0, key_y}}, sample_mm, elements);
  }
  return script + plot_command(elements) + "unset label\n";
}

}  // namespace

std::string floor_plan_script(const FloorPlan& plan, FigureFormat format, const std::filesystem::path& output) {
  const PlanLayout layout = layout_of(plan);
  const Page page{page_width, layout.height};
  std::string script = fmt::format("set encoding utf8\nset terminal {} noenhanced\nset output {}\n$outlines << EOD\n",
                                   terminal(format, page), gnuplot_string(output.string()));
  for (const auto& outline : plan.outlines) {
    for (const DrawnPoint& p : outline) script += fmt::format("{} {}\n", p.x, p.y);
    script += "\n";
  }
  script += "EOD\nunset key\nset multiplot\n" + plan_page(plan, layout, page);
  for (std::size_t i = 0; i < plan.panels.size(); ++i) script += draw_panel(plan, layout, page, i);
  return script + "unset multiplot\nunset output\n";
}

void draw(const FloorPlan& plan, const std::filesystem::path& output) {
  if (plan.panels.empty()) throw std::invalid_argument("a floor plan without panels");
  write_picture(
      [&](FigureFormat format, const std::filesystem::path& file) { return floor_plan_script(plan, format, file); },
      {plan.title, plan.footnote}, output);
}

}  // namespace ridgeloc::results
