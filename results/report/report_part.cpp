#include "results/report/report_part.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "results/schema/text.hpp"

namespace ridgeloc::results {

std::vector<Measure> measures_of(const Schema& schema) {
  std::vector<Measure> measures;
  for (const MetricInfo& metric : schema.metrics) {
    const auto lead = metric.yes_no         ? Measure::Lead::Rate
                      : metric.heavy_tailed ? Measure::Lead::Median
                                            : Measure::Lead::Mean;
    measures.push_back({metric.name, metric.unit, metric.description, lead, true, false, false, !metric.alarm.empty()});
  }
  for (std::size_t e = 0; e < schema.events.size(); ++e) {
    const EventInfo& event = schema.events[e];
    measures.push_back(
        {event.name, "1", event.description, Measure::Lead::Rate, false, e < schema.statuses, event.is_failure, false});
  }
  return measures;
}

const Measure& measure_of(const std::vector<Measure>& measures, const SummaryRow& row) {
  return *std::ranges::find(measures, row.metric, &Measure::name);
}

std::string measure_title(const Measure& measure) {
  return measure.unit == "1" ? measure.name : fmt::format("{} [{}]", measure.name, measure.unit);
}

std::string measure_id(std::size_t measure) {
  return fmt::format("measure{}", measure + 1);
}

bool is_flagged(const SummaryRow& row, const Measure& measure) {
  const bool bound = measure.lead == Measure::Lead::Rate && row.mean == 0.0;
  return row.n > 0 && !row.trusted && !bound;
}

std::string sentence(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text.ends_with('.') ? text : text + ".";
}

bool is_drawn(const Header& header, const std::string& measure) {
  return std::ranges::any_of(
      header.figures, [&](const FigureSpec& figure) { return std::ranges::find(figure.y, measure) != figure.y.end(); });
}

bool is_solver(const Summary& summary, std::size_t method) {
  for (std::size_t cell = 0; cell < summary.header.cells.size(); ++cell)
    if (!summary.of(cell, method).events.empty()) return true;
  return false;
}

std::vector<HtmlTable::Column> factor_columns(const Header& header) {
  std::vector<HtmlTable::Column> columns;
  for (const Axis& axis : header.axes)
    columns.push_back(
        {axis.unit == "1" ? axis.name : fmt::format("{} [{}]", axis.name, axis.unit), HtmlTable::Kind::Head});
  return columns;
}

std::vector<HtmlCell> factor_cells(const Header& header, std::size_t cell) {
  std::vector<HtmlCell> cells;
  for (std::size_t a = 0; a < header.axes.size(); ++a)
    cells.push_back(text_cell(factor_text(header.axes[a].values[header.cells[cell].indices[a]])));
  return cells;
}

}  // namespace ridgeloc::results
