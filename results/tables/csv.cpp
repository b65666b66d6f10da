#include "results/tables/csv.hpp"

#include <limits>
#include <ostream>
#include <string>
#include <string_view>

#include "results/schema/text.hpp"
#include "results/summary/ratio.hpp"
#include "results/summary/summary_columns.hpp"

namespace ridgeloc::results {
namespace {

void write_axis_names(const Header& header, CsvWriter& csv) {
  for (const Axis& axis : header.axes) csv.text(axis.name);
}

void write_factors(const Header& header, std::size_t cell, CsvWriter& csv) {
  for (std::size_t axis = 0; axis < header.axes.size(); ++axis) {
    csv.factor(header.axes[axis].values[header.cells[cell].indices[axis]]);
  }
}

}  // namespace

void write_summary_csv(const Summary& of_methods, std::ostream& out, DecimalMark mark) {
  const Summary summary = with_ratios(of_methods);
  CsvWriter csv(out, mark);
  write_axis_names(summary.header, csv);
  for (const char* name : {"method", "metric", "unit", "n"}) csv.text(name);
  for (const SummaryColumn& column : summary_columns) csv.text(column.name);
  csv.text("trusted");
  csv.text("beyond");
  for (const SummaryColumn& column : summary_bar_columns) csv.text(column.name);
  csv.text("rms_trusted");
  csv.end_line();
  for (const SummaryRow& row : summary_rows(summary)) {
    write_factors(summary.header, row.cell, csv);
    csv.text(summary.header.methods[row.method].label);
    csv.text(row.metric);
    csv.text(row.unit);
    csv.number(row.n);
    for (const SummaryColumn& column : summary_columns) csv.number(row.*column.value);
    csv.number(std::uint64_t{row.trusted});
    csv.number(row.beyond);
    for (const SummaryColumn& column : summary_bar_columns) csv.number(row.*column.value);
    csv.number(std::uint64_t{row.rms_trusted});
    csv.end_line();
  }
  csv.flush();
}

void write_cell_comparisons_csv(const Header& header, const std::vector<CellComparison>& comparisons, std::ostream& out,
                                DecimalMark mark) {
  CsvWriter csv(out, mark);
  write_axis_names(header, csv);
  for (const char* name :
       {"against", "method", "metric", "unit", "n", "n_against", "difference", "difference_mcse", "difference_lo",
        "difference_hi", "ratio", "ratio_mcse", "ratio_lo", "ratio_hi", "correlation", "paired", "trusted"}) {
    csv.text(name);
  }
  csv.end_line();
  for (const CellComparison& pair : comparisons) {
    const MetricInfo& metric = header.schema.metrics[pair.metric];
    write_factors(header, pair.cell, csv);
    csv.text(cell_text(header, pair.against));
    csv.text(header.methods[pair.method].label);
    csv.text(metric.name);
    csv.text(metric.unit);
    csv.number(pair.n);
    csv.number(pair.n_against);
    for (const Estimate& estimate : {pair.difference, pair.ratio})
      for (const double value : {estimate.value, estimate.error, estimate.lo, estimate.hi}) csv.number(value);
    csv.number(pair.correlation);
    csv.number(pair.paired);
    csv.number(std::uint64_t{pair.trusted});
    csv.end_line();
  }
  csv.flush();
}

void write_trials_csv_heading(const Header& header, std::ostream& out, DecimalMark mark) {
  CsvWriter csv(out, mark);
  write_axis_names(header, csv);
  for (const char* name : {"trial", "method", "status"}) csv.text(name);
  for (const MetricInfo& metric : header.schema.metrics) csv.text(metric.name);
  csv.end_line();
  csv.flush();
}

void write_trials_csv(const Header& header, std::size_t cell, std::size_t method, const TrialTable& trials,
                      std::ostream& out, DecimalMark mark) {
  CsvWriter csv(out, mark);
  for (std::size_t row = 0; row < trials.trial.size(); ++row) {
    write_factors(header, cell, csv);
    csv.number(trials.trial[row]);
    csv.text(header.methods[method].label);
    csv.text(trials.status.empty() ? "" : header.schema.events.at(trials.status[row]).name);
    for (const std::vector<double>& metric : trials.metrics) {
      csv.number(metric.empty() ? std::numeric_limits<double>::quiet_NaN() : metric[row]);
    }
    csv.end_line();
  }
  csv.flush();
}

void write_failures_csv(const Header& header, const FailureList& failures, std::ostream& out, DecimalMark mark) {
  CsvWriter csv(out, mark);
  write_axis_names(header, csv);
  for (const char* name : {"trial", "method", "reason"}) csv.text(name);
  csv.end_line();
  const std::vector<std::string> reasons = failure_reasons(header.schema);
  for (const auto& [key, trials] : failures.trials()) {
    for (const std::uint64_t trial : trials) {
      write_factors(header, key.cell, csv);
      csv.number(trial);
      csv.text(header.methods[key.method].label);
      csv.text(reasons[key.reason]);
      csv.end_line();
    }
  }
  csv.flush();
}

}  // namespace ridgeloc::results
