#include "results/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "results/report/html.hpp"
#include "results/report/report_assets.hpp"
#include "results/report/report_part.hpp"
#include "results/store/result_file.hpp"
#include "results/util/digest.hpp"

namespace ridgeloc::results {
namespace {

constexpr std::size_t worst_per_method = 5;

struct Part {
  const char* id;
  const char* title;
  std::string (*html)(const ReportSource&, const ReportPlace&);
};
constexpr Part parts[] = {{"winners", "Which method is best where", report_winners},
                          {"overview", "Overview", report_overview},
                          {"figures", "Figures", report_figures},
                          {"study", "What was studied", report_study},
                          {"numbers", "Numbers", report_numbers},
                          {"failures", "Failures", report_failures},
                          {"checks", "Checks", report_checks},
                          {"origin", "Where the numbers come from", report_origin},
                          {"commands", "How to make it again", report_commands}};

std::string title_of(const ReportSource& source) {
  const Header& header = source.summary.header;
  return header.title.empty() ? header.experiment : header.title;
}

/// The first metric with rare large values; without one the first that has values at all.
std::size_t leading_metric(const Schema& schema) {
  const auto heavy = std::ranges::find(schema.metrics, true, &MetricInfo::heavy_tailed);
  return heavy == schema.metrics.end() ? 0 : static_cast<std::size_t>(heavy - schema.metrics.begin());
}

std::vector<WorstTrial> worst_trials(const ReportSource& source) {
  std::vector<std::vector<WorstTrial>> by_method(source.summary.header.methods.size());
  visit_trials(source.path, source.worst_metric,
               [&](std::size_t cell, std::size_t method, const std::vector<std::uint64_t>& trials,
                   const std::vector<double>& values) {
                 if (!is_solver(source.summary, method)) return;
                 std::vector<WorstTrial>& worst = by_method[method];
                 for (std::size_t i = 0; i < values.size(); ++i) {
                   const bool counts = worst.size() < worst_per_method || values[i] > worst.back().value;
                   if (!(values[i] == values[i]) || !counts) continue;
                   if (worst.size() == worst_per_method) worst.pop_back();
                   const auto place = std::ranges::find_if(worst, [&](const auto& w) { return w.value < values[i]; });
                   worst.insert(place, {cell, method, trials[i], values[i]});
                 }
               });
  std::vector<WorstTrial> all;
  for (const auto& worst : by_method) std::ranges::copy(worst, std::back_inserter(all));
  return all;
}

ReportPlace place_of(std::size_t index, std::size_t results) {
  return {fmt::format("r{}-", index + 1), results > 1 ? 3 : 2};
}

std::string contents(const std::vector<ReportSource>& sources) {
  std::string list;
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const ReportPlace place = place_of(i, sources.size());
    std::string links;
    for (const Part& part : parts)
      links += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", place.id(part.id), part.title);
    list += sources.size() == 1 ? links
                                : fmt::format("<li><a href=\"#{}\">{}</a>\n<ol>\n{}</ol></li>\n", place.id("result"),
                                              html_text(title_of(sources[i])), links);
  }
  return fmt::format("<nav aria-label=\"Contents\">\n<ol>\n{}</ol>\n</nav>\n", list);
}

std::string body(const std::vector<ReportSource>& sources, const std::string& title) {
  std::string html = html_heading(1, "title", title);
  for (std::size_t i = 0; i < sources.size(); ++i) {
    const ReportPlace place = place_of(i, sources.size());
    if (sources.size() > 1) html += html_heading(2, place.id("result"), title_of(sources[i]));
    for (const Part& part : parts) {
      html += fmt::format("<section aria-labelledby=\"{}\">\n", place.id(part.id));
      html += html_heading(place.level, place.id(part.id), part.title);
      html += part.html(sources[i], place) + "</section>\n";
    }
  }
  return html;
}

}  // namespace

ReportSource read_report_source(const std::string& path) {
  ReportSource source;
  Snapshot snapshot = read_snapshot(path);
  source.path = path;
  source.summary = summarize(snapshot);
  source.rows = summary_rows(source.summary);
  source.failures = std::move(snapshot.failures);
  source.worst_metric = leading_metric(source.summary.header.schema);
  if (!snapshot.is_sealed) return source;
  source.provenance = read_provenance(path);
  source.digest = data_digest(path);
  source.worst = worst_trials(source);
  return source;
}

std::string report_html(const std::vector<ReportSource>& sources) {
  const std::string title = sources.size() == 1 ? title_of(sources.front()) : fmt::format("{} studies", sources.size());
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'sha256-{}'; "
      "script-src 'sha256-{}'; base-uri 'none'; form-action 'none'\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n"
      "<a class=\"skip\" href=\"#main\">To the content</a>\n{}<main id=\"main\">\n{}</main>\n<script>{}</script>\n"
      "</body>\n</html>\n",
      sha256_base64(report_style()), sha256_base64(report_script()), html_text(title), report_style(),
      contents(sources), body(sources, title), report_script());
}

}  // namespace ridgeloc::results
