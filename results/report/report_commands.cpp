#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "results/report/html.hpp"
#include "results/report/report_part.hpp"
#include "results/schema/text.hpp"
#include "results/util/shell.hpp"

namespace ridgeloc::results {
namespace {

using Kind = HtmlTable::Kind;

std::string replay_command(const ReportSource& source, std::size_t cell, std::size_t method, std::uint64_t trial) {
  const Header& header = source.summary.header;
  std::string factors;
  for (std::size_t a = 0; a < header.axes.size(); ++a)
    factors += fmt::format("{}{}={}", factors.empty() ? "" : ",", header.axes[a].name,
                           factor_text(header.axes[a].values[header.cells[cell].indices[a]]));
  return fmt::format("ridgeloc replay {}{} --trial {} --method {}", shell_word(source.path),
                     factors.empty() ? "" : " --cell " + shell_word(factors), trial,
                     shell_word(header.methods[method].label));
}

std::string worst_trials_text(const ReportSource& source) {
  if (source.worst.empty()) return "<p>The result keeps no values of single trials.</p>\n";
  const Header& header = source.summary.header;
  const Measure measure = measures_of(header.schema)[source.worst_metric];
  HtmlTable table(fmt::format("The largest {} of each method, among the trials whose values are kept", measure.name),
                  {{"method", Kind::Head}, {measure_title(measure), Kind::Number}, {"command"}});
  for (const WorstTrial& worst : source.worst)
    table.add({text_cell(header.methods[worst.method].label),
               number_cell(worst.value),
               {html_code(replay_command(source, worst.cell, worst.method, worst.trial))}});
  return table.html();
}

std::string failed_trials(const ReportSource& source) {
  if (source.failures.empty()) return "<p>No failed trial is listed.</p>\n";
  const Header& header = source.summary.header;
  const std::vector<std::string> reasons = failure_reasons(header.schema);
  HtmlTable table("The first failed trial of each cell, method and reason",
                  {{"method", Kind::Head}, {"reason"}, {"command"}});
  for (const auto& [key, trials] : source.failures.trials())
    table.add({text_cell(header.methods[key.method].label),
               text_cell(reasons[key.reason]),
               {html_code(replay_command(source, key.cell, key.method, trials.front()))}});
  const std::string all = fmt::format("ridgeloc export {} --failures", shell_word(source.path));
  return html_details("The first failed trials", false, table.html()) +
         fmt::format("<p>All that are listed, the first {} of each kind:</p>\n{}", FailureList::limit,
                     html_command(all));
}

}  // namespace

std::string report_commands(const ReportSource& source, const ReportPlace& place) {
  const Header& header = source.summary.header;
  const std::string result = shell_word(source.path);
  const std::string stem = std::filesystem::path(source.path).stem().string();
  const std::string study = shell_word(stem + ".toml");
  const std::string again = shell_word(stem + "-again.h5");
  const auto heading = [&](const char* id, const char* text) {
    return html_heading(place.level + 1, place.id(id), text);
  };

  std::string html;
  if (source.summary.is_sealed) {
    html += heading("verify", "Check it");
    html += "<p>Compares the file with its digests and computes some of its blocks again, bit for bit:</p>\n";
    html += html_command("ridgeloc verify " + result);
  }
  html += heading("rerun", "Compute it again");
  html += fmt::format(
      "<p>The study is part of the result (and of this page, under <a href=\"#{}\">What was studied</a>). To "
      "take it out and run it:</p>\n",
      place.id("study"));
  html += html_command(fmt::format("ridgeloc export {} --study -o {}", result, study));
  html += html_command(fmt::format("ridgeloc run {}{} -o {}", study,
                                   header.isa == mixed_isa ? "" : " --isa " + shell_word(header.isa), again));
  if (source.summary.is_sealed) {
    html += fmt::format("<p>A complete result has the same digest as this one, if this one is complete too: {}</p>\n",
                        html_code(source.digest));
    html += html_command(fmt::format("ridgeloc verify --digest {}", again));
  }
  html += heading("figures-again", "Draw the figures");
  if (!header.figures.empty()) html += html_command(fmt::format("ridgeloc plot {} --format pdf", result));
  html += "<p>Each figure above has its own command.</p>\n";
  html += heading("worst", "Look at the worst trials") + worst_trials_text(source);
  html += heading("failed", "Look at failed trials") + failed_trials(source);
  return html;
}

}  // namespace ridgeloc::results
