#include <fmt/format.h>

#include <string>

#include "results/report/html.hpp"
#include "results/report/report_part.hpp"

namespace ridgeloc::results {
namespace {

std::string entry(std::string_view term, const std::string& html) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_text(term), html);
}

}  // namespace

std::string report_origin(const ReportSource& source, const ReportPlace&) {
  const Header& header = source.summary.header;
  const Provenance& origin = source.provenance;
  std::string libraries;
  for (const auto& [name, version] : origin.libraries)
    libraries += fmt::format("{}{} {}", libraries.empty() ? "" : ", ", name, version);
  std::string times;
  for (const auto& [phase, seconds] : origin.wall_time_s)
    times += fmt::format("{}{}: {:.3g} s", times.empty() ? "" : ", ", phase, seconds);

  std::string html = "<dl>\n";
  html += entry("Random numbers",
                fmt::format("Philox4x32-10, seed {}; each number is a function of the seed, of what it is "
                            "for, and of its trial, whatever the number of threads",
                            header.seed));
  html += entry("Experiment", html_text(fmt::format("{}, version {}", header.experiment, header.experiment_version)));
  html += entry("Instruction set", html_text(header.isa));
  html += entry("Study", html_code(header.study_hash));
  if (!source.summary.is_sealed)
    return html + entry("Program, machine, digest", "not kept before the run has come to its end") + "</dl>\n";
  html += entry("Program", html_text("ridgeloc " + origin.program_version));
  html +=
      entry("Commit", html_code(origin.git_commit) + (origin.git_dirty ? ", with changes that it does not hold" : ""));
  html += entry("Compiler", html_text(origin.compiler) + " " + html_code(origin.flags));
  html += entry("Libraries", html_text(libraries));
  html += entry("Processor", html_text(origin.processor));
  html += entry("Threads", origin.threads == 0 ? "none: merged from other results" : fmt::format("{}", origin.threads));
  html += entry("Wall time", times.empty() ? "not kept" : html_text(times));
  html += entry("Date", html_text(origin.date));
  if (!origin.contributions.empty()) {
    std::string lines;
    for (const std::string& line : origin.contributions)
      lines += fmt::format("{}{}", lines.empty() ? "" : "<br>", html_text(line));
    html += entry("Made from", lines);
  }
  html += entry("Data, SHA-256", html_code(source.digest));
  return html + "</dl>\n";
}

}  // namespace ridgeloc::results
