#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/report/html.hpp"
#include "results/report/report_part.hpp"
#include "results/schema/text.hpp"
#include "results/util/shell.hpp"

namespace ridgeloc::results {
namespace {

using Kind = HtmlTable::Kind;

constexpr const char* flag_mark = " <b class=\"flag\">!</b>";

/// The number that leads for a measure, with its error or interval.
HtmlCell estimate_cell(const SummaryRow& row, const Measure& measure) {
  if (row.n == 0) return {"-"};
  // Order statistics hold for every distribution.
  const bool is_median = measure.lead == Measure::Lead::Median;
  const bool flagged = !is_median && is_flagged(row, measure);
  return {html_text(estimate_text(row, measure.lead)) + (flagged ? flag_mark : ""),
          exact_text(is_median ? row.p50 : row.mean)};
}

const char* reading(const Measure& measure) {
  switch (measure.lead) {
    case Measure::Lead::Rate:
      return "rate [95 % interval], or 0 [≤ upper 95 % bound]";
    case Measure::Lead::Median:
      return "median [95 % interval]";
    case Measure::Lead::Mean:
      break;
  }
  return "mean ± Monte Carlo standard error";
}

using RowsOfMeasure = std::map<std::pair<std::size_t, std::size_t>, const SummaryRow*>;

/// One measure: a row per cell, a column per method that reports it, or per difference of methods; empty if none does.
std::string table_of(const Header& header, const Measure& measure, const RowsOfMeasure& rows, bool differences) {
  std::vector<std::size_t> methods;
  std::vector<HtmlTable::Column> columns = factor_columns(header);
  for (std::size_t m = 0; m < header.methods.size(); ++m) {
    if (!rows.contains({0, m}) || header.methods[m].difference.has_value() != differences) continue;
    methods.push_back(m);
    columns.push_back({header.methods[m].label, Kind::Number});
  }
  if (methods.empty()) return "";
  HtmlTable table(
      fmt::format("{}{}: {}", measure_title(measure), differences ? ", paired differences" : "", reading(measure)),
      columns);
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
    std::vector<HtmlCell> cells = factor_cells(header, cell);
    for (const std::size_t m : methods) cells.push_back(estimate_cell(*rows.at({cell, m}), measure));
    table.add(cells);
  }
  return table.html();
}

std::string measure_tables(const Header& header, const Measure& measure, const RowsOfMeasure& rows) {
  // A difference may be negative, and quantiles of negative values are not kept.
  Measure difference = measure;
  difference.lead = Measure::Lead::Mean;
  return fmt::format("<p class=\"note\">{}</p>\n", html_text(sentence(measure.description))) +
         table_of(header, measure, rows, false) + table_of(header, difference, rows, true);
}

constexpr std::pair<const char*, double SummaryRow::*> numbers[] = {{"mean", &SummaryRow::mean},
                                                                    {"error", &SummaryRow::mcse},
                                                                    {"95 % low", &SummaryRow::lo},
                                                                    {"95 % high", &SummaryRow::hi},
                                                                    {"sd", &SummaryRow::sd},
                                                                    {"sd error", &SummaryRow::sd_mcse},
                                                                    {"rms", &SummaryRow::rms},
                                                                    {"rms low", &SummaryRow::rms_lo},
                                                                    {"rms high", &SummaryRow::rms_hi},
                                                                    {"min", &SummaryRow::min},
                                                                    {"p05", &SummaryRow::p05},
                                                                    {"p25", &SummaryRow::p25},
                                                                    {"median", &SummaryRow::p50},
                                                                    {"median low", &SummaryRow::p50_lo},
                                                                    {"median high", &SummaryRow::p50_hi},
                                                                    {"p75", &SummaryRow::p75},
                                                                    {"p95", &SummaryRow::p95},
                                                                    {"p95 low", &SummaryRow::p95_lo},
                                                                    {"p95 high", &SummaryRow::p95_hi},
                                                                    {"max", &SummaryRow::max}};

/// A page with more rows than this opens slowly, and nobody reads it.
constexpr std::size_t most_rows_in_full = 2000;

/// All numbers of the summary, a row per cell, method and measure.
std::string full_table(const ReportSource& source) {
  const Header& header = source.summary.header;
  std::vector<HtmlTable::Column> columns = factor_columns(header);
  columns.insert(columns.end(), {{"method", Kind::Head}, {"measure", Kind::Head}, {"unit"}});
  columns.push_back({"n", Kind::Number});
  for (const auto& number : numbers) columns.push_back({number.first, Kind::Number});
  columns.push_back({"flag"});
  const std::vector<Measure> measures = measures_of(header.schema);
  HtmlTable table("Every cell, method and measure", columns);
  for (const SummaryRow& row : source.rows) {
    std::vector<HtmlCell> cells = factor_cells(header, row.cell);
    for (const std::string& text : {header.methods[row.method].label, row.metric, row.unit})
      cells.push_back(text_cell(text));
    cells.push_back(count_cell(row.n));
    for (const auto& number : numbers) cells.push_back(number_cell(row.*number.second));
    cells.push_back({is_flagged(row, measure_of(measures, row)) ? flag_mark : ""});
    table.add(cells);
  }
  return table.html();
}

}  // namespace

std::string report_numbers(const ReportSource& source, const ReportPlace& place) {
  const Header& header = source.summary.header;
  std::map<std::string_view, RowsOfMeasure> rows;
  for (const SummaryRow& row : source.rows) rows[row.metric][{row.cell, row.method}] = &row;
  std::string html =
      "<p>A table per measure, those that figures show are open. <b class=\"flag\">!</b> marks an error bar that "
      "is not reliable itself. Cells and methods share trials and are not independent: whether two methods differ is a "
      "question about their paired difference, trial by trial, and bars that overlap do not answer it.</p>\n";
  const std::vector<Measure> measures = measures_of(header.schema);
  for (std::size_t m = 0; m < measures.size(); ++m) {
    const auto found = rows.find(measures[m].name);
    if (found == rows.end()) continue;
    html += fmt::format("<div id=\"{}\">\n", place.id(measure_id(m)));
    html += html_details(measure_title(measures[m]), is_drawn(header, measures[m].name),
                         measure_tables(header, measures[m], found->second));
    html += "</div>\n";
  }
  if (source.rows.size() <= most_rows_in_full) {
    html += html_details("All numbers in one table", false, full_table(source));
    html += "<p>The same as CSV, for other programs:</p>\n";
  } else {
    html += fmt::format("<p>All {} rows with every number, as CSV:</p>\n", source.rows.size());
  }
  return html + html_command(fmt::format("ridgeloc export {}", shell_word(source.path)));
}

}  // namespace ridgeloc::results
