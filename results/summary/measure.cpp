#include "results/summary/measure.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "results/schema/text.hpp"
#include "results/statistics/interval.hpp"

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

bool is_flagged(const SummaryRow& row, const Measure& measure) {
  const bool bound = measure.lead == Measure::Lead::Rate && row.mean == 0.0;
  return row.n > 0 && !row.trusted && !bound;
}

std::vector<std::string> drawn_measures(const Header& header) {
  const std::vector<Measure> known = measures_of(header.schema);
  std::vector<std::string> names;
  for (const FigureSpec& figure : header.figures) {
    for (const std::string& name : figure.y) {
      const bool is_known = std::ranges::find(known, name, &Measure::name) != known.end();
      if (is_known && std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  return names;
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

std::uint64_t failed_trials(const Schema& schema, const Statistics& statistics) {
  if (statistics.events.empty()) return 0;
  std::uint64_t failed = 0;
  for (std::size_t s = 0; s < schema.statuses; ++s)
    if (schema.events[s].is_failure) failed += statistics.events[s];
  return failed;
}

std::string estimate_text(const SummaryRow& row, Measure::Lead lead) {
  if (row.n == 0) return "-";
  switch (lead) {
    case Measure::Lead::Rate:
      return row.mean > 0.0 ? text_with_interval(row.mean, row.lo, row.hi)
                            : fmt::format("0 [≤ {:.2g}]", upper_bound_of_none(row.n));
    case Measure::Lead::Median:
      return text_with_interval(row.p50, row.p50_lo, row.p50_hi);
    case Measure::Lead::Mean:
      break;
  }
  return text_with_error(row.mean, row.mcse);
}

const char* estimate_kind(Measure::Lead lead) {
  switch (lead) {
    case Measure::Lead::Rate:
      return "rate [95 %]";
    case Measure::Lead::Median:
      return "median [95 %]";
    case Measure::Lead::Mean:
      break;
  }
  return "mean ± error";
}

std::string rate_text(std::uint64_t count, std::uint64_t trials) {
  if (trials == 0) return "-";
  if (count == 0) return fmt::format("0 [≤ {:.2g}]", upper_bound_of_none(trials));
  const Interval interval = wilson_interval(count, trials);
  return text_with_interval(static_cast<double>(count) / static_cast<double>(trials), interval.lo, interval.hi);
}

}  // namespace ridgeloc::results
