#include "results/pictures/page_script.hpp"

#include <fmt/core.h>

#include <cmath>

#include "results/pictures/gnuplot.hpp"

namespace ridgeloc::results {

std::string terminal(FigureFormat format, const Page& page) {
  constexpr double css_pixels_per_mm = 96.0 / 25.4;
  constexpr double print_pixels_per_mm = 300.0 / 25.4;
  const auto pixels = [](double mm, double per_mm) { return std::lround(mm * per_mm); };
  switch (format) {
    case FigureFormat::Svg:
      return fmt::format("svg size {},{} font 'sans-serif,8' fontscale 1.333 background 'white'",
                         pixels(page.width, css_pixels_per_mm), pixels(page.height, css_pixels_per_mm));
    case FigureFormat::Pdf:
      return fmt::format("pdfcairo size {:.3f}cm,{:.3f}cm font 'Sans,8' fontscale 0.75 linewidth 1.5 pointscale 0.8",
                         page.width / 10.0, page.height / 10.0);
    case FigureFormat::Png:
      return fmt::format("pngcairo size {},{} font 'Sans,8' fontscale 3.125 linewidth 3.125 pointscale 3.125",
                         pixels(page.width, print_pixels_per_mm), pixels(page.height, print_pixels_per_mm));
  }
  return {};
}

void append(std::string& list, std::string_view separator, std::string_view element) {
  if (!list.empty()) list += separator;
  list += element;
}

std::string plot_command(const std::string& elements) {
  return fmt::format("plot \\\n  {}\n", elements.empty() ? "NaN" : elements);
}

std::string page_text(const Page& page, double x_mm, double y_mm, std::string_view value, std::string_view options) {
  return fmt::format("set label {} at screen {:.5f},{:.5f} {} front\n", gnuplot_string(value), x_mm / page.width,
                     1.0 - y_mm / page.height, options);
}

std::string margins(const Page& page, double left, double right, double top, double bottom) {
  return fmt::format(
      "set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\n"
      "set tmargin at screen {:.5f}\nset bmargin at screen {:.5f}\n",
      left / page.width, right / page.width, 1.0 - top / page.height, 1.0 - bottom / page.height);
}

std::string axis_ranges(const AxisRange& x, const AxisRange& y) {
  return fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", x.low, x.high, y.low, y.high);
}

}  // namespace ridgeloc::results
