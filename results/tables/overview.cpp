#include "results/tables/overview.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "results/schema/text.hpp"
#include "results/summary/alarm.hpp"
#include "results/summary/completeness.hpp"
#include "results/tables/headline.hpp"
#include "results/tables/overview_tables.hpp"

namespace ridgeloc::results {
namespace {

/// Methods that run on trials, of all or of some; labels of what belongs to the scene are none.
std::size_t solver_count(const Summary& summary, const std::vector<std::size_t>& methods) {
  return static_cast<std::size_t>(std::ranges::count_if(methods, [&](std::size_t m) { return is_solver(summary, m); }));
}

std::string shown_text(const Summary& summary, const SummaryChoice& choice) {
  const SummaryChoice all = whole(summary.header);
  const auto part = [](std::size_t shown, std::size_t of, const char* what) {
    return shown == of ? "all " + count_text(of, what) : fmt::format("{} of {}", shown, count_text(of, what));
  };
  const std::size_t shown = solver_count(summary, choice.methods);
  const std::size_t solvers = solver_count(summary, all.methods);
  if (shown == solvers && choice.cells.size() == all.cells.size()) return "";
  return fmt::format("shown: {}{}\n", part(choice.cells.size(), all.cells.size(), "cell"),
                     solvers == 0 ? "" : fmt::format(", {}", part(shown, solvers, "method")));
}

std::string common_axes_text(const Header& header, const std::vector<std::size_t>& cells) {
  const std::vector<std::size_t> varying = varying_axes(header, cells);
  std::vector<std::size_t> common;
  for (std::size_t axis = 0; axis < header.axes.size(); ++axis)
    if (std::ranges::find(varying, axis) == varying.end()) common.push_back(axis);
  return common.empty() ? "" : wrapped_text("in every row: " + axes_text(header, common, cells.front()), summary_width);
}

std::string overview_heading(const Summary& summary, const SummaryChoice& choice) {
  const Header& header = summary.header;
  const std::size_t solvers = solver_count(summary, whole(header).methods);
  return wrapped_text(header.title.empty() ? header.experiment : header.title, summary_width) +
         fmt::format("experiment {} (version {}){}, seed {}\n", header.experiment, header.experiment_version,
                     solvers == 0 ? "" : fmt::format(", {}", count_text(solvers, "method")), header.seed) +
         wrapped_text(completeness_text(summary), summary_width) + shown_text(summary, choice) +
         common_axes_text(header, choice.cells);
}

std::string left_out_text(const FittedText& fitted, const char* hint) {
  if (fitted.left_out.empty()) return "";
  return wrapped_text(fmt::format("no room for: {} ({})", fmt::join(fitted.left_out, ", "), hint), summary_width);
}

std::string section(const FittedTable& table, const std::string& title, const char* hint) {
  if (table.rows.empty() || table.columns.empty()) return "";
  const FittedText fitted = fitted_text(table, summary_width);
  return fmt::format("\n{}{}{}", title.empty() ? "" : wrapped_text(title, summary_width), fitted.text,
                     left_out_text(fitted, hint));
}

std::string failure_section(const Summary& summary, const SummaryChoice& choice) {
  const std::string where =
      choice.cells.size() == 1 ? "" : fmt::format(", {} together", count_text(choice.cells.size(), "cell"));
  return section(failure_table(summary, choice), "Failures" + where + ":", "--metric NAME shows an outcome by cell");
}

std::string audit_line(const Summary& summary, const SummaryChoice& choice) {
  const auto& metrics = summary.header.schema.metrics;
  if (std::ranges::all_of(metrics, [](const MetricInfo& metric) { return metric.alarm.empty(); })) return "";
  std::set<std::pair<std::size_t, std::size_t>> shown;
  for (const std::size_t cell : choice.cells)
    for (const std::size_t method : choice.methods) shown.emplace(cell, method);
  const std::string text = alarm_text(summary, shown);
  return fmt::format(
      "\n{}", text.empty() ? "not audited: no trial was checked independently\n" : wrapped_text(text, summary_width));
}

/// How to read what the tables say.
std::string notes(const std::string& tables, const DifferenceTable& differences, std::size_t cells) {
  const auto has = [&](const char* sign) { return tables.find(sign) != std::string::npos; };
  std::string text = wrapped_text("± error: Monte Carlo standard error; [95 %]: 95 % interval", summary_width);
  if (has("[≤"))
    text += wrapped_text("0 [≤ u]: not seen once; with 95 % confidence the rate is at most u = 3 / n", summary_width);
  if (has(" !"))
    text += wrapped_text(
        "!: the error itself is not reliable (fewer than 10 values or outcomes of a kind, heavy tails, or values "
        "beyond 1e6)",
        summary_width);
  if (differences.any_marked)
    text += wrapped_text(fmt::format("*: the 95 % interval excludes 0; **: so would that of the largest of {}",
                                     count_text(differences.tested, "difference")),
                         summary_width);
  if (cells > 1) text += "Cells that share trials are not independent.\n";
  return fmt::format("\n{}", text);
}

}  // namespace

std::string summary_overview(const Summary& summary, const SummaryChoice& choice) {
  const std::vector<Measure> measures = chosen_measures(summary, choice);
  const DifferenceTable differences = difference_table(summary, choice, measures);
  constexpr const char* hint = "--metric NAME shows a column";
  const std::string tables =
      section(method_table(summary, choice, measures), "", hint) +
      section(differences.table, "Differences on the same trials, first minus second: mean ± error", hint) +
      failure_section(summary, choice);
  return overview_heading(summary, choice) + tables + audit_line(summary, choice) +
         notes(tables, differences, choice.cells.size());
}

}  // namespace ridgeloc::results
