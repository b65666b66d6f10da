#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <vector>

#include "results/report/html.hpp"
#include "results/report/report_part.hpp"
#include "results/schema/text.hpp"

namespace ridgeloc::results {
namespace {

using Kind = HtmlTable::Kind;

/// Tables of more rows are folded.
constexpr std::size_t most_open_rows = 60;

/// How often something happened, and its rate with an interval, or a bound where it never did.
HtmlCell rate_cell(std::uint64_t count, std::uint64_t trials) {
  if (trials == 0) return {"-"};
  return {html_text(rate_text(count, trials)), exact_text(static_cast<double>(count) / static_cast<double>(trials))};
}

/// The total of a method over all cells.
Statistics total_of(const Summary& summary, std::size_t method) {
  Statistics total;
  for (std::size_t cell = 0; cell < summary.header.cells.size(); ++cell) {
    const Statistics& statistics = summary.of(cell, method);
    if (statistics.trials > 0) total = merge(total, statistics);
  }
  return total;
}

/// One row of statuses: trials, a count per status, the failed ones and their rate.
std::vector<HtmlCell> status_cells(const Schema& schema, const Statistics& statistics) {
  std::vector<HtmlCell> cells = {count_cell(statistics.trials)};
  for (std::size_t s = 0; s < schema.statuses; ++s)
    cells.push_back(count_cell(statistics.events.empty() ? 0 : statistics.events[s]));
  const std::uint64_t failed = failed_trials(schema, statistics);
  cells.push_back(count_cell(failed));
  cells.push_back(rate_cell(failed, statistics.trials));
  return cells;
}

std::vector<HtmlTable::Column> status_columns(const Schema& schema) {
  std::vector<HtmlTable::Column> columns = {{"trials", Kind::Number}};
  for (std::size_t s = 0; s < schema.statuses; ++s) columns.push_back({schema.events[s].name, Kind::Number});
  columns.push_back({"failed", Kind::Number});
  columns.push_back({"rate of failures [95 %]", Kind::Number});
  return columns;
}

/// Checks of one method: how many, how many raised the alarm, and the rate.
std::vector<HtmlCell> check_cells(const Statistics& statistics, std::size_t metric) {
  const bool has = metric < statistics.metrics.size();
  const std::uint64_t checks = has ? statistics.metrics[metric].moments.n : 0;
  const std::uint64_t alarms = has ? yes_count(statistics.metrics[metric]) : 0;
  return {count_cell(checks), count_cell(alarms), rate_cell(alarms, checks)};
}

template <typename T>
std::vector<T> joined(std::vector<T> first, const std::vector<T>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

std::vector<HtmlTable::Column> method_columns(std::vector<HtmlTable::Column> first = {}) {
  first.push_back({"method", Kind::Head});
  return first;
}

/// Two tables, of all cells together and one by one, that count with `cells_of` what each method did.
template <typename CellsOf>
std::string count_tables(const Summary& summary, const std::string& what, const std::vector<HtmlTable::Column>& columns,
                         CellsOf&& cells_of) {
  const Header& header = summary.header;
  HtmlTable total(what + ", by method, over all cells", joined(method_columns(), columns));
  HtmlTable each(what + ", by cell and method", joined(method_columns(factor_columns(header)), columns));
  for (std::size_t m = 0; m < header.methods.size(); ++m)
    if (is_solver(summary, m)) total.add(joined({text_cell(header.methods[m].label)}, cells_of(total_of(summary, m))));
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell)
    for (std::size_t m = 0; m < header.methods.size(); ++m)
      if (is_solver(summary, m))
        each.add(joined(joined(factor_cells(header, cell), {text_cell(header.methods[m].label)}),
                        cells_of(summary.of(cell, m))));
  return total.html() + html_details("By cell and method", each.rows() <= most_open_rows, each.html());
}

}  // namespace

std::string report_failures(const ReportSource& source, const ReportPlace&) {
  const std::string html =
      "<p>Each trial of a method ends with one status. A trial that fails is not drawn again and not left out: it is "
      "counted "
      "here, and what it adds to a measure is part of that measure's meaning. So rates and the measures over all "
      "trials "
      "describe what a user would get, and the measures over converged trials what remains if failures are seen.</p>\n";
  const Schema& schema = source.summary.header.schema;
  return html + count_tables(source.summary, "How trials ended", status_columns(schema),
                             [&](const Statistics& statistics) { return status_cells(schema, statistics); });
}

std::string report_checks(const ReportSource& source, const ReportPlace&) {
  std::string html;
  const std::vector<MetricInfo>& metrics = source.summary.header.schema.metrics;
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    if (metrics[i].alarm.empty()) continue;
    html += fmt::format(
        "<p>{} A yes is an error in the program or the machine. 0 [≤ u]: none was seen, and with 95 % "
        "confidence the rate is at most u = 3 / n.</p>\n",
        html_text(sentence(metrics[i].description)));
    html += count_tables(source.summary, fmt::format("{}, {}", metrics[i].name, metrics[i].alarm),
                         {{"checks", Kind::Number}, {"alarms", Kind::Number}, {"rate [95 %]", Kind::Number}},
                         [&](const Statistics& statistics) { return check_cells(statistics, i); });
  }
  return html.empty() ? "<p>The experiment has no measure that raises an alarm.</p>\n" : html;
}

}  // namespace ridgeloc::results
