#pragma once
// Internal to results: the parts of a report, each the HTML of a section of one result.

#include <string>
#include <string_view>
#include <vector>

#include "results/report/html.hpp"
#include "results/report/report.hpp"
#include "results/summary/measure.hpp"

namespace ridgeloc::results {

/// Where a part stands on the page.
struct ReportPlace {
  std::string prefix;  ///< of all ids, so that several results can stand on one page
  int level = 2;       ///< of its heading

  std::string id(std::string_view name) const { return prefix + std::string(name); }
};

/// The name of the table of a measure within its report.
std::string measure_id(std::size_t measure);

/// A text as a sentence: with a capital and a full stop.
std::string sentence(std::string text);

/// The columns and cells that say which cell of the sweep a row of a table is about.
std::vector<HtmlTable::Column> factor_columns(const Header& header);
std::vector<HtmlCell> factor_cells(const Header& header, std::size_t cell);

/// The methods with their settings, those in which they differ first.
std::string report_methods(const Header& header);

std::string report_winners(const ReportSource& source, const ReportPlace& place);
std::string report_overview(const ReportSource& source, const ReportPlace& place);
std::string report_study(const ReportSource& source, const ReportPlace& place);
std::string report_figures(const ReportSource& source, const ReportPlace& place);
std::string report_numbers(const ReportSource& source, const ReportPlace& place);
std::string report_failures(const ReportSource& source, const ReportPlace& place);
std::string report_checks(const ReportSource& source, const ReportPlace& place);
std::string report_origin(const ReportSource& source, const ReportPlace& place);
std::string report_commands(const ReportSource& source, const ReportPlace& place);

}  // namespace ridgeloc::results
