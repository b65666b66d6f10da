#pragma once
// Internal to results: the parts of a report, each the HTML of a section of one result.

#include <string>
#include <string_view>
#include <vector>

#include "results/report/html.hpp"
#include "results/report/report.hpp"

namespace ridgeloc::results {

/// Where a part stands on the page.
struct ReportPlace {
  std::string prefix;  ///< of all ids, so that several results can stand on one page
  int level = 2;       ///< of its heading

  std::string id(std::string_view name) const { return prefix + std::string(name); }
};

/// What is reported of each cell and method, as tables and texts name it: the metrics, then the events.
struct Measure {
  enum class Lead { Mean, Median, Rate };  ///< the number that speaks for it
  std::string name;
  std::string unit;
  std::string description;
  Lead lead = Lead::Mean;
  bool is_metric = true;
  bool is_status = false;
  bool is_failure = false;
  bool is_alarm = false;
};
std::vector<Measure> measures_of(const Schema& schema);

/// The measure that a row of the summary is about.
const Measure& measure_of(const std::vector<Measure>& measures, const SummaryRow& row);

/// Name and unit: "error_m [m]".
std::string measure_title(const Measure& measure);

/// The name of the table of a measure within its report.
std::string measure_id(std::size_t measure);

/// Whether a row carries a `!`: its error bar is not reliable itself. A rate of something never seen has a bound
/// instead of a bar.
bool is_flagged(const SummaryRow& row, const Measure& measure);

/// A text as a sentence: with a capital and a full stop.
std::string sentence(std::string text);

/// Whether a figure of the study shows the measure.
bool is_drawn(const Header& header, const std::string& measure);

/// Whether the method runs on trials, and is no mere label of what belongs to the scene: then it has statuses.
bool is_solver(const Summary& summary, std::size_t method);

/// The columns and cells that say which cell of the sweep a row of a table is about.
std::vector<HtmlTable::Column> factor_columns(const Header& header);
std::vector<HtmlCell> factor_cells(const Header& header, std::size_t cell);

std::string report_overview(const ReportSource& source, const ReportPlace& place);
std::string report_study(const ReportSource& source, const ReportPlace& place);
std::string report_figures(const ReportSource& source, const ReportPlace& place);
std::string report_numbers(const ReportSource& source, const ReportPlace& place);
std::string report_failures(const ReportSource& source, const ReportPlace& place);
std::string report_checks(const ReportSource& source, const ReportPlace& place);
std::string report_origin(const ReportSource& source, const ReportPlace& place);
std::string report_commands(const ReportSource& source, const ReportPlace& place);

}  // namespace ridgeloc::results
