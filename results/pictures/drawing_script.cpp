#include "results/pictures/drawing_script.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "results/pictures/drawing_layout.hpp"
#include "results/pictures/gnuplot.hpp"
#include "results/pictures/picture_file.hpp"

namespace ridgeloc::results {
namespace {

constexpr const char* contour_colour = "#bbbbbb";

Page page_of(const DrawingLayout& layout) {
  return {DrawingLayout::width, layout.height};
}

struct PathStyle {
  const char* colour;
  int filled_mark;
  const char* dash;
  double line_width;
};

/// The first of several paths is the broadest, so that it shows under those that lie on it.
PathStyle path_style(std::size_t index, std::size_t paths) {
  const double under =
      static_cast<double>(paths - 1 - index) / static_cast<double>(std::max<std::size_t>(paths, 2) - 1);
  return {colours[index % colours.size()], filled_marks[index % filled_marks.size()], dashes[index % dashes.size()],
          0.8 + 1.1 * under};
}

/// gnuplot's point type and size of places, and their colour where they have no other.
struct MarkStyle {
  const char* point;
  const char* colour;
};
MarkStyle mark_style(DrawnMark mark) {
  switch (mark) {
    case DrawnMark::Dot:
      return {"pt 7 ps 0.7", "#999999"};
    case DrawnMark::Plus:
      return {"pt 1 ps 1.3 lw 1.6", "#000000"};
    case DrawnMark::Square:
      return {"pt 4 ps 0.9 lw 1", "#000000"};
    case DrawnMark::Diamond:
      return {"pt 12 ps 1.6 lw 1", "#000000"};
    case DrawnMark::Triangle:
      return {"pt 8 ps 1.6 lw 1", "#000000"};
  }
  return {};
}

std::string mark_element(const std::string& points, DrawnMark mark, const char* colour) {
  return fmt::format("{} using 1:2 with points {} lc rgb '{}'", points, mark_style(mark).point, colour);
}

std::string line_element(const std::string& lines, const PathStyle& style) {
  return fmt::format("{} lw {:.2f} lc rgb '{}' dt {}", lines, style.line_width, style.colour, style.dash);
}

std::string marks_element(const std::string& points, const PathStyle& style) {
  return fmt::format("{} using 1:2 with points pt {} ps 0.45 lw 1 lc rgb '{}'", points, style.filled_mark,
                     style.colour);
}

/// The larger mark at the end of a path; a hollow one covers the line below it.
std::string end_element(const std::string& point, const PathStyle& style, bool filled) {
  const auto mark = [&](int type, const char* colour) {
    return fmt::format("{} using 1:2 with points pt {} ps 0.9 lw 1.2 lc rgb '{}'", point, type, colour);
  };
  if (filled) return mark(style.filled_mark, style.colour);
  return fmt::format("{}{}{}", mark(style.filled_mark, "white"), next_element,
                     mark(style.filled_mark - 1, style.colour));
}

std::string block(const std::string& name, const std::vector<DrawnPoint>& points) {
  std::string text = name + " << EOD\n";
  for (const DrawnPoint& p : points) text += fmt::format("{} {}\n", p.x, p.y);
  return text + "EOD\n";
}

/// Finds the contours before anything is drawn: gnuplot writes them into a data block.
std::string find_contours(const DrawnContours& contours, const DrawingWindow& window) {
  std::string script = "$grid << EOD\n";
  const std::size_t rows = contours.values.size();
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t columns = contours.values[i].size();
    const auto place = [](const AxisRange& range, std::size_t index, std::size_t count) {
      return range.low + (range.high - range.low) * static_cast<double>(index) / static_cast<double>(count - 1);
    };
    for (std::size_t j = 0; j < columns; ++j) {
      const double value = contours.values[i][j];
      script += fmt::format("{:.7g} {:.7g} {}\n", place(window.x, j, columns), place(window.y, i, rows),
                            std::isfinite(value) ? fmt::format("{:.7g}", value) : "NaN");
    }
    script += "\n";
  }
  return script + fmt::format(
                      "EOD\nset contour base\nunset surface\nset cntrparam levels discrete {}\nset table $contours\n"
                      "splot $grid using 1:2:3 with lines\nunset table\nunset contour\nset surface\n",
                      fmt::join(contours.levels, ","));
}

/// All that is written on the page outside of the plot, and the legend's samples, in coordinates of millimetres.
std::string drawing_page(const Drawing& drawing, const DrawingLayout& layout) {
  const Page page = page_of(layout);
  std::string script;
  const auto lines = [&](const std::vector<std::string>& texts, double x, double y, double height,
                         const char* options) {
    for (const std::string& line : texts) {
      script += page_text(page, x, y, line, options);
      y += height;
    }
  };
  lines(layout.title, DrawingLayout::width / 2.0, layout.title_y, PageStyle::line_height, "center font ',8.5'");
  lines(layout.footnote, PageStyle::edge, layout.footnote_y, PageStyle::footnote_line_height,
        "left font ',5.5' tc rgb '#444444'");
  script += page_text(page, (layout.left + layout.right) / 2.0, layout.x_label_y, drawing.x_label, "center font ',7'");
  script += page_text(page, PageStyle::edge + PageStyle::line_height / 2.0, (layout.top + layout.bottom) / 2.0,
                      drawing.y_label, "center rotate by 90 font ',7'");

  script += margins(page, 0.0, DrawingLayout::width, 0.0, layout.height) + "unset border\nunset tics\n" +
            axis_ranges({0.0, DrawingLayout::width}, {layout.height, 0.0});
  std::string elements;
  const auto texts = legend_texts(drawing);
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const auto [x, y] = layout.legend[i];
    script += page_text(page, x + PageStyle::sample_length + PageStyle::sample_gap, y, texts[i], "left font ',7'");
    const std::string name = fmt::format("$sample{}", i);
    const std::string middle = fmt::format("$sample{}_middle", i);
    script += block(name, {{x, y}, {x + PageStyle::sample_length, y}});
    script += block(middle, {{x + PageStyle::sample_length / 2.0, y}});
    const std::string line = name + " using 1:2 with lines";
    const std::size_t paths = drawing.paths.size();
    if (i < paths) {
      const PathStyle style = path_style(i, paths);
      append(elements, next_element, line_element(line, style));
      append(elements, next_element, end_element(middle, style, drawing.paths[i].filled_end));
    } else if (i - paths < drawing.places.size()) {
      const DrawnMark mark = drawing.places[i - paths].mark;
      append(elements, next_element, mark_element(middle, mark, mark_style(mark).colour));
    } else {
      append(elements, next_element, fmt::format("{} lw 0.6 lc rgb '{}'", line, contour_colour));
    }
  }
  return script + plot_command(elements) + "unset label\n";
}

/// A path with its marks.
std::string draw_path(const VisiblePath& path, const PathStyle& style, bool filled_end, const std::string& name,
                      std::string& elements) {
  std::string script;
  const auto add = [&](const std::string& element) { append(elements, next_element, element); };
  if (!path.pieces.empty()) {
    script += name + "_line << EOD\n";
    for (const auto& piece : path.pieces) {
      for (const DrawnPoint& p : piece) script += fmt::format("{} {}\n", p.x, p.y);
      script += "\n";
    }
    script += "EOD\n";
    add(line_element(name + "_line using 1:2 with lines", style));
  }
  if (!path.marks.empty()) {
    script += block(name + "_marks", path.marks);
    add(marks_element(name + "_marks", style));
  }
  if (path.end) {
    script += block(name + "_end", {*path.end});
    add(end_element(name + "_end", style, filled_end));
  }
  if (path.arrow) {
    script += fmt::format("{}_arrow << EOD\n{} {} {} {}\nEOD\n", name, path.arrow->from.x, path.arrow->from.y,
                          path.arrow->to.x - path.arrow->from.x, path.arrow->to.y - path.arrow->from.y);
    add(fmt::format("{}_arrow using 1:2:3:4 with vectors head filled size screen 0.015,20 lw 1 lc rgb '{}'", name,
                    style.colour));
  }
  return script;
}

std::string draw_plane(const Drawing& drawing, const DrawingLayout& layout) {
  const Page page = page_of(layout);
  std::string script = margins(page, layout.left, layout.right, layout.top, layout.bottom) +
                       "set border 3 lw 0.7\nset tics nomirror out scale 0.5,0.3 font ',7'\n"
                       "set xtics nomirror offset 0,0.4\nset ytics nomirror\n" +
                       axis_ranges(drawing.window.x, drawing.window.y);
  for (const PlacedText& placed : layout.texts) {
    script += page_text(page, placed.x, placed.y, placed.text, "center font ',7' tc rgb '#555555'");
  }
  std::string elements;
  if (drawing.contours && !drawing.contours->levels.empty()) {
    append(elements, next_element, fmt::format("$contours using 1:2 with lines lw 0.6 lc rgb '{}'", contour_colour));
  }
  const auto add_places = [&](bool below) {
    for (std::size_t i = 0; i < drawing.places.size(); ++i) {
      const DrawnPlaces& places = drawing.places[i];
      if ((places.mark == DrawnMark::Dot) != below) continue;
      for (std::size_t k = 0; k < places.points.size(); ++k) {
        if (!drawing.window.contains(places.points[k])) continue;
        const std::string name = fmt::format("$place{}_{}", i, k);
        script += block(name, {places.points[k]});
        append(elements, next_element,
               mark_element(name, places.mark,
                            places.paths.empty() ? mark_style(places.mark).colour
                                                 : path_style(places.paths[k], drawing.paths.size()).colour));
      }
    }
  };
  add_places(true);
  for (std::size_t i = 0; i < layout.paths.size(); ++i) {
    script += draw_path(layout.paths[i], path_style(i, layout.paths.size()), drawing.paths[i].filled_end,
                        fmt::format("$path{}", i), elements);
  }
  add_places(false);
  return script + plot_command(elements);
}

}  // namespace

std::string drawing_script(const Drawing& drawing, FigureFormat format, const std::filesystem::path& output) {
  const DrawingLayout layout = drawing_layout(drawing);
  std::string script = "set encoding utf8\n";
  if (drawing.contours && !drawing.contours->levels.empty()) script += find_contours(*drawing.contours, drawing.window);
  script += fmt::format("set terminal {} noenhanced\nset output {}\n", terminal(format, page_of(layout)),
                        gnuplot_string(output.string()));
  return script + "unset key\nset multiplot\n" + drawing_page(drawing, layout) + draw_plane(drawing, layout) +
         "unset multiplot\nunset output\n";
}

void draw(const Drawing& drawing, const std::filesystem::path& output) {
  write_picture(
      [&](FigureFormat format, const std::filesystem::path& file) { return drawing_script(drawing, format, file); },
      {drawing.title, drawing.footnote}, output);
}

}  // namespace ridgeloc::results
