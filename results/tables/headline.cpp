#include "results/tables/headline.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace ridgeloc::results {
namespace {

using Names = std::vector<std::string>;

void add_name(Names& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

std::vector<Measure> measures_named(const Schema& schema, const Names& names) {
  const std::vector<Measure> measures = measures_of(schema);
  std::vector<Measure> found;
  for (const std::string& name : names) found.push_back(*std::ranges::find(measures, name, &Measure::name));
  return found;
}

bool any_reports(const Summary& summary, const SummaryChoice& choice, const Measure& measure) {
  return std::ranges::any_of(choice.methods, [&](std::size_t m) { return reports(summary, choice.cells, m, measure); });
}

/// Quantiles of negative values are not kept, and so none of differences, which do not count here.
bool lacks_median(const Summary& summary, const SummaryChoice& choice, const Measure& measure) {
  for (const std::size_t cell : choice.cells) {
    for (const std::size_t method : choice.methods) {
      if (summary.header.methods[method].difference) continue;
      const SummaryRow row = summary_row(summary.header, method, summary.of(cell, method), measure.name);
      if (row.n > 0 && std::isnan(row.p50)) return true;
    }
  }
  return false;
}

}  // namespace

bool is_compared(const Summary& summary, const Measure& measure) {
  std::vector<std::size_t> cells(summary.header.cells.size());
  std::iota(cells.begin(), cells.end(), std::size_t{0});
  for (std::size_t m = 0; m < summary.header.methods.size(); ++m)
    if (summary.header.methods[m].difference && reports(summary, cells, m, measure)) return true;
  return false;
}

std::vector<Measure> leading_measures(const Summary& summary) {
  const Header& header = summary.header;
  const Schema& schema = header.schema;
  Names names = drawn_measures(header);
  for (const Measure& measure : measures_of(schema))
    if (measure.is_metric && is_compared(summary, measure)) add_name(names, measure.name);
  if (names.empty()) {
    if (!schema.metrics.empty()) names.push_back(schema.metrics.front().name);
    for (std::size_t s = 0; s < schema.statuses; ++s)
      if (!schema.events[s].is_failure) add_name(names, schema.events[s].name);
  }
  return measures_named(schema, names);
}

std::vector<Measure> chosen_measures(const Summary& summary, const SummaryChoice& choice) {
  const Schema& schema = summary.header.schema;
  const auto reported = [&](std::vector<Measure> measures) {
    std::erase_if(measures, [&](const Measure& measure) { return !any_reports(summary, choice, measure); });
    return measures;
  };
  std::vector<Measure> measures = measures_named(schema, choice.metrics);
  if (measures.empty()) measures = reported(leading_measures(summary));
  if (measures.empty()) measures = reported(measures_of(schema));
  for (Measure& measure : measures) {
    if (measure.lead == Measure::Lead::Median && lacks_median(summary, choice, measure))
      measure.lead = Measure::Lead::Mean;
  }
  return measures;
}

bool reports(const Summary& summary, const std::vector<std::size_t>& cells, std::size_t method,
             const Measure& measure) {
  const std::vector<MetricInfo>& metrics = summary.header.schema.metrics;
  const auto index =
      static_cast<std::size_t>(std::ranges::find(metrics, measure.name, &MetricInfo::name) - metrics.begin());
  return std::ranges::any_of(cells, [&](std::size_t cell) {
    const Statistics& statistics = summary.of(cell, method);
    if (!measure.is_metric) return !statistics.events.empty() && statistics.trials > 0;
    return index < statistics.metrics.size() &&
           statistics.metrics[index].moments.n + statistics.metrics[index].beyond > 0;
  });
}

}  // namespace ridgeloc::results
