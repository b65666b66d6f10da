#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "results/figures/figure.hpp"
#include "results/figures/figure_data.hpp"
#include "results/report/html.hpp"
#include "results/report/report_part.hpp"
#include "results/util/file_system.hpp"
#include "results/util/shell.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

/// gnuplot's SVG as a part of a page: without the head of a file of its own, without titles, which browsers show as
/// tooltips and which hold commands of gnuplot, and with names that no other figure has.
std::string inlined(std::string svg, const std::string& prefix, const std::string& description) {
  svg.erase(0, svg.find("<svg"));
  const std::size_t head = svg.find('>');
  std::string attributes = svg.substr(0, head);
  attributes = std::regex_replace(attributes, std::regex("\\s+xmlns(:xlink)?=\"[^\"]*\""), "");
  std::string content = svg.substr(head);
  content = std::regex_replace(content, std::regex("<(title|desc)>[^<]*</(title|desc)>"), "");
  content = std::regex_replace(content, std::regex("<g [^>]*>\\s*</g>\\s*"), "");
  content = std::regex_replace(content, std::regex("\\bid=(['\"])"), "id=$1" + prefix);
  content = std::regex_replace(content, std::regex("xlink:href=(['\"])#"), "href=$1#" + prefix);
  content = std::regex_replace(content, std::regex("url\\(#"), "url(#" + prefix);
  return fmt::format("{} role=\"img\" aria-label=\"{}\"{}", attributes, html_text(description), content);
}

std::string drawn(const Summary& summary, const FigureSpec& spec) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "figure.svg";
  draw_figure(summary, spec, file);
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Links to the tables with the numbers that a figure shows.
std::string links(const Header& header, const FigureSpec& spec, const ReportPlace& place) {
  const std::vector<Measure> measures = measures_of(header.schema);
  std::string html;
  for (std::size_t m = 0; m < measures.size(); ++m) {
    if (std::find(spec.y.begin(), spec.y.end(), measures[m].name) == spec.y.end()) continue;
    html += fmt::format("{}<a href=\"#{}\">{}</a>", html.empty() ? "" : ", ", place.id(measure_id(m)),
                        html_text(measures[m].name));
  }
  return html;
}

std::string figure(const ReportSource& source, const FigureSpec& spec, const ReportPlace& place, std::size_t index) {
  const std::string title = spec.title.empty() ? spec.name : spec.title;
  const std::string command =
      fmt::format("ridgeloc plot {} --figure {}", shell_word(source.path), shell_word(spec.name));
  std::string html = "<figure>\n";
  std::string caption;
  // What a study asks for in vain is its own affair and no reason to withhold the rest; but for that, errors are ours.
  std::optional<FigureData> data;
  try {
    data = figure_data(source.summary, spec);
  } catch (const core::InputError& error) {
    caption = fmt::format("<p class=\"warn\">{}</p>\n", html_text(error.what()));
  }
  if (data) {
    html += inlined(drawn(source.summary, spec), place.id(fmt::format("figure{}-", index + 1)),
                    fmt::format("{}: {}", title, sentence(description_of(*data))));
    caption = fmt::format("<p>{} {}</p>\n<p>The numbers: {}</p>\n", html_text(sentence(description_of(*data))),
                          html_text(sentence(data->footnote)), links(source.summary.header, spec, place));
  }
  return html + fmt::format("<figcaption>\n<p><strong>{}</strong></p>\n{}{}</figcaption>\n</figure>\n",
                            html_text(title), caption, html_command(command));
}

}  // namespace

std::string report_figures(const ReportSource& source, const ReportPlace& place) {
  const std::vector<FigureSpec>& figures = source.summary.header.figures;
  if (figures.empty()) return "<p>The study asks for none; a <code>[[figure]]</code> in the study file does.</p>\n";
  std::string html = "<div class=\"figures\">\n";
  for (std::size_t i = 0; i < figures.size(); ++i) html += figure(source, figures[i], place, i);
  return html + "</div>\n";
}

}  // namespace ridgeloc::results
