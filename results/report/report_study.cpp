#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "results/report/html.hpp"
#include "results/report/report_part.hpp"
#include "results/schema/text.hpp"
#include "results/statistics/interval.hpp"
#include "results/summary/completeness.hpp"

namespace ridgeloc::results {
namespace {

using Kind = HtmlTable::Kind;

std::string paragraph(const std::string& text) {
  return fmt::format("<p>{}</p>\n", html_text(text));
}

std::string factors(const Header& header) {
  if (header.axes.empty()) return paragraph("Nothing is swept: there is one cell.");
  HtmlTable table("Swept factors", {{"factor", Kind::Head}, {"meaning"}, {"unit"}, {"values"}});
  std::size_t grid = 1;
  for (const Axis& axis : header.axes) {
    std::string values;
    for (const FactorValue& value : axis.values) values += (values.empty() ? "" : ", ") + factor_text(value);
    table.add({text_cell(axis.name), text_cell(axis.description), text_cell(axis.unit), text_cell(values)});
    grid *= axis.values.size();
  }
  const std::string crossing =
      grid == header.cells.size()
          ? fmt::format("All {} combinations of these values were studied; each is a cell.", grid)
          : fmt::format(
                "{} of the {} combinations of these values were studied, each a cell: some factors move together, "
                "or combinations were left out.",
                header.cells.size(), grid);
  return table.html() + paragraph(crossing);
}

std::string measures(const Header& header) {
  HtmlTable table("Measures: estimated of each cell and method",
                  {{"measure", Kind::Head}, {"unit"}, {"meaning"}, {"reported as"}});
  for (const Measure& measure : measures_of(header.schema)) {
    const char* lead = measure.lead == Measure::Lead::Rate     ? "rate"
                       : measure.lead == Measure::Lead::Median ? "median first: heavy tails"
                                                               : "mean first";
    table.add({text_cell(measure.name), text_cell(measure.unit), text_cell(measure.description),
               text_cell(fmt::format("{}{}{}", lead, measure.is_status ? "; a status" : "",
                                     measure.is_failure ? " that is a failure"
                                     : measure.is_alarm ? "; an alarm"
                                                        : ""))});
  }
  return table.html();
}

std::string trials_asked(const Summary& summary) {
  const std::uint64_t asked = summary.header.trials;
  const bool more = std::ranges::any_of(summary.statistics, [&](const Statistics& s) { return s.trials > asked; });
  return paragraph(
      fmt::format("{} trials per cell were asked for{}. The result is {}.", asked,
                  more ? "; where there are more, a stop rule wanted them, or they had been computed before" : "",
                  completeness_text(summary)));
}

/// The Monte Carlo error of a row's leading number, relative to it; of a rate as it is. NaN where it is not known.
double error_of(const SummaryRow& row, const Measure& measure) {
  switch (measure.lead) {
    case Measure::Lead::Rate:
      return row.mcse;
    case Measure::Lead::Median:
      return (row.p50_hi - row.p50_lo) / (2.0 * normal_quantile_975 * row.p50);
    case Measure::Lead::Mean:
      break;
  }
  return row.mcse / std::abs(row.mean);
}

std::string precision(const ReportSource& source) {
  const Header& header = source.summary.header;
  HtmlTable table("Monte Carlo standard errors reached", {{"measure", Kind::Head},
                                                          {"number"},
                                                          {"estimates", Kind::Number},
                                                          {"typical error, %", Kind::Number},
                                                          {"largest error, %", Kind::Number},
                                                          {"where"}});
  for (const Measure& measure : measures_of(header.schema)) {
    std::vector<double> errors;
    const SummaryRow* worst = nullptr;
    double largest = 0.0;
    for (const SummaryRow& row : source.rows) {
      // Of a difference the error relative to itself says nothing.
      if (row.metric != measure.name || row.n == 0 || header.methods[row.method].difference) continue;
      const double error = error_of(row, measure);
      if (!std::isfinite(error)) continue;
      errors.push_back(error);
      if (worst == nullptr || error > largest) {
        worst = &row;
        largest = error;
      }
    }
    if (worst == nullptr) continue;
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::ranges::nth_element(errors, middle);
    const char* number = measure.lead == Measure::Lead::Rate     ? "rate, in points"
                         : measure.lead == Measure::Lead::Median ? "median, relative"
                                                                 : "mean, relative";
    const std::string cell = cell_text(header, worst->cell);
    table.add({text_cell(measure.name), text_cell(number), count_cell(errors.size()), number_cell(100.0 * *middle),
               number_cell(100.0 * largest),
               text_cell(cell + (cell.empty() ? "" : ": ") + header.methods[worst->method].label)});
  }
  return table.html();
}

}  // namespace

std::string report_study(const ReportSource& source, const ReportPlace& place) {
  const Header& header = source.summary.header;
  const auto heading = [&](const char* id, const char* text) {
    return html_heading(place.level + 1, place.id(id), text);
  };
  std::string html = heading("methods", "Methods");
  html += paragraph("All methods solve the same trials: what differs between them is not the luck of the draw.") +
          report_methods(header);
  html += heading("factors", "Data-generating factors") + factors(header);
  html += html_details("The whole study, every setting written out", false,
                       fmt::format("<pre tabindex=\"0\"><code>{}</code></pre>\n", html_text(header.study_toml)));
  html += heading("measures", "Estimands and measures") + measures(header);
  html += heading("trials", "Number of trials, and what it buys");
  html += trials_asked(source.summary);
  html += paragraph(
      "Whether they are enough shows in the errors: the Monte Carlo standard error of the number that leads "
      "for each measure, the median and the largest one over all cells and methods. That of a median is the width of "
      "its 95 % interval over 3.92.");
  return html + precision(source);
}

}  // namespace ridgeloc::results
