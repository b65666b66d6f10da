#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>

#include "results/report/html.hpp"
#include "results/report/report_part.hpp"
#include "results/summary/alarm.hpp"
#include "results/summary/completeness.hpp"

namespace ridgeloc::results {
namespace {

std::string plain_entry(std::string_view term, std::string_view text) {
  return fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_text(term), html_text(text));
}

std::string flag(bool warn, std::string_view text) {
  return fmt::format("<li{}>{}{}</li>\n", warn ? " class=\"warn\"" : "", warn ? "<strong>Note:</strong> " : "",
                     html_text(text));
}

std::string alarm_flag(const ReportSource& source) {
  const Header& header = source.summary.header;
  std::set<std::pair<std::size_t, std::size_t>> all;
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell)
    for (std::size_t method = 0; method < header.methods.size(); ++method) all.emplace(cell, method);
  const std::string text = alarm_text(source.summary, all);
  const bool any = std::ranges::any_of(source.failures.trials(), [&](const auto& entry) {
    const std::string reason = failure_reasons(header.schema)[entry.first.reason];
    return std::ranges::any_of(header.schema.metrics,
                               [&](const MetricInfo& m) { return m.name == reason && !m.alarm.empty(); });
  });
  return text.empty() ? flag(true, "No trial was checked independently.") : flag(any, sentence(text));
}

std::string failure_flag(const Summary& summary) {
  std::uint64_t runs = 0;
  std::uint64_t failed = 0;
  for (const Statistics& statistics : summary.statistics) {
    if (statistics.events.empty()) continue;
    runs += statistics.trials;
    failed += failed_trials(summary.header.schema, statistics);
  }
  return flag(false,
              fmt::format("{} of {} solutions failed ({:.3g} %); none was drawn again or left out.", failed, runs,
                          runs == 0 ? 0.0 : 100.0 * static_cast<double>(failed) / static_cast<double>(runs)));
}

std::string bar_flags(const ReportSource& source) {
  const std::vector<Measure> measures = measures_of(source.summary.header.schema);
  std::size_t bars = 0;
  std::size_t flagged = 0;
  std::uint64_t beyond = 0;
  for (const SummaryRow& row : source.rows) {
    if (row.n == 0) continue;
    ++bars;
    if (is_flagged(row, measure_of(measures, row))) ++flagged;
    beyond += row.beyond;
  }
  std::string html =
      flag(false, fmt::format("{} of {} error bars are not reliable themselves and carry a !: fewer than 10 "
                              "values or outcomes of a kind, heavy tails, or values beyond 1e6.",
                              flagged, bars));
  if (beyond > 0)
    html += flag(false, fmt::format("{} values are infinite or above 1e6: they enter medians and quantiles, not means.",
                                    beyond));
  return html;
}

}  // namespace

std::string report_overview(const ReportSource& source, const ReportPlace&) {
  const Header& header = source.summary.header;
  const Provenance& origin = source.provenance;
  std::string html;
  html += header.aims.empty() ? "<p class=\"note\">The study does not say what its aims are.</p>\n"
                              : fmt::format("<p class=\"aims\">{}</p>\n", html_text(header.aims));
  const auto solvers = [&] {
    std::size_t count = 0;
    for (std::size_t m = 0; m < header.methods.size(); ++m) count += is_solver(source.summary, m) ? 1 : 0;
    return count;
  }();
  html += "<dl>\n";
  html += plain_entry("Result", source.path);
  html += plain_entry("Experiment", fmt::format("{}, version {}", header.experiment, header.experiment_version));
  html += plain_entry("Size", fmt::format("{} cells, {} methods", header.cells.size(), solvers));
  html += plain_entry("Seed", fmt::format("{}", header.seed));
  if (source.summary.is_sealed)
    html += plain_entry("Computed", fmt::format("{}, ridgeloc {}", origin.date, origin.program_version));
  html += "</dl>\n<ul class=\"flags\">\n";
  html += flag(!is_complete(source.summary), "The result is " + completeness_text(source.summary) + ".");
  html += failure_flag(source.summary) + alarm_flag(source) + bar_flags(source);
  if (origin.git_dirty) html += flag(true, "The program was built from source with changes that no commit holds.");
  if (header.isa == mixed_isa)
    html += flag(true,
                 "Blocks of different instruction sets stand side by side; they cannot be computed again bit for bit.");
  return html + "</ul>\n";
}

}  // namespace ridgeloc::results
