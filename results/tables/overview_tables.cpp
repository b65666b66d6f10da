#include "results/tables/overview_tables.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "results/schema/text.hpp"
#include "results/statistics/interval.hpp"
#include "results/tables/headline.hpp"

namespace ridgeloc::results {
namespace {

using Align = FittedTable::Align;

/// Chance that differences that are none are marked, of one and of the largest of all.
constexpr double significance_level = 0.05;

/// A table with a group per chosen cell, and no columns or rows yet.
FittedTable table_of_cells(const Header& header, const SummaryChoice& choice, std::string label) {
  FittedTable table;
  table.label = std::move(label);
  const std::vector<std::size_t> axes = varying_axes(header, choice.cells);
  for (const std::size_t axis : axes) {
    const bool is_text = std::holds_alternative<std::string>(header.axes[axis].values.front());
    table.keys.push_back({header.axes[axis].name, "", is_text ? Align::Left : Align::Right});
  }
  for (const std::size_t cell : choice.cells) {
    std::vector<std::string>& texts = table.groups.emplace_back();
    for (const std::size_t axis : axes)
      texts.push_back(factor_text(header.axes[axis].values[header.cells[cell].indices[axis]]));
  }
  return table;
}

std::string entry_of(const SummaryRow& row, const Measure& measure) {
  const bool flagged = measure.lead != Measure::Lead::Median && is_flagged(row, measure);
  return estimate_text(row, measure.lead) + (flagged ? " !" : "");
}

/// The chosen methods that are differences, or are not, and report any of the measures.
std::vector<std::size_t> shown_methods(const Summary& summary, const SummaryChoice& choice,
                                       const std::vector<Measure>& measures, bool differences) {
  std::vector<std::size_t> methods;
  for (const std::size_t m : choice.methods) {
    if (summary.header.methods[m].difference.has_value() != differences) continue;
    if (std::ranges::any_of(measures, [&](const Measure& x) { return reports(summary, choice.cells, m, x); }))
      methods.push_back(m);
  }
  return methods;
}

bool have_equal_trials(const Summary& summary, const SummaryChoice& choice, const std::vector<std::size_t>& methods) {
  if (methods.empty()) return true;
  const std::uint64_t first = summary.of(choice.cells.front(), methods.front()).trials;
  return std::ranges::all_of(choice.cells, [&](std::size_t cell) {
    return std::ranges::all_of(methods, [&](std::size_t m) { return summary.of(cell, m).trials == first; });
  });
}

/// None for a bar that is not reliable itself.
std::string significance(const SummaryRow& row, double limit) {
  if (!row.trusted) return "";
  if (std::fabs(row.mean) > student_quantile(limit, row.n - 1) * row.mcse) return " **";
  return row.lo > 0.0 || row.hi < 0.0 ? " *" : "";
}

std::string reasons_text(const Schema& schema, const Failures& failures) {
  std::vector<std::string> reasons;
  for (std::size_t s = 0; s < schema.statuses; ++s) {
    if (schema.events[s].is_failure && failures.by_status[s] > 0)
      reasons.push_back(fmt::format("{} {}", schema.events[s].name, failures.by_status[s]));
  }
  return fmt::format("{}", fmt::join(reasons, ", "));
}

}  // namespace

FittedTable method_table(const Summary& summary, const SummaryChoice& choice, const std::vector<Measure>& measures) {
  const Header& header = summary.header;
  FittedTable table = table_of_cells(header, choice, "method");
  const std::vector<std::size_t> methods = shown_methods(summary, choice, measures, false);
  const bool tells_trials = !have_equal_trials(summary, choice, methods);
  if (tells_trials) table.columns.push_back({"trials", "", Align::Right});
  for (const Measure& measure : measures)
    table.columns.push_back({measure_title(measure), estimate_kind(measure.lead), Align::Point});
  for (std::size_t group = 0; group < choice.cells.size(); ++group) {
    for (const std::size_t m : methods) {
      const Statistics& statistics = summary.of(choice.cells[group], m);
      FittedTable::Row row{group, header.methods[m].label, {}};
      if (tells_trials) row.entries.push_back(fmt::format("{}", statistics.trials));
      for (const Measure& measure : measures)
        row.entries.push_back(entry_of(summary_row(header, m, statistics, measure.name), measure));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

DifferenceTable difference_table(const Summary& summary, const SummaryChoice& choice,
                                 const std::vector<Measure>& measures) {
  const Header& header = summary.header;
  std::vector<Measure> compared;
  for (Measure measure : measures) {
    if (!is_compared(summary, measure)) continue;
    measure.lead = Measure::Lead::Mean;
    compared.push_back(measure);
  }
  DifferenceTable differences{table_of_cells(header, choice, "difference"), 0, false};
  std::vector<std::pair<FittedTable::Row, std::vector<SummaryRow>>> rows;
  const std::vector<std::size_t> methods = shown_methods(summary, choice, compared, true);
  for (std::size_t group = 0; group < choice.cells.size(); ++group) {
    for (const std::size_t m : methods) {
      auto& [row, numbers] =
          rows.emplace_back(FittedTable::Row{group, header.methods[m].label, {}}, std::vector<SummaryRow>());
      for (const Measure& measure : compared) {
        numbers.push_back(summary_row(header, m, summary.of(choice.cells[group], m), measure.name));
        if (numbers.back().n > 0) ++differences.tested;
      }
    }
  }
  const double limit =
      two_sided_quantile(significance_level / static_cast<double>(std::max<std::size_t>(differences.tested, 1)));
  for (const Measure& measure : compared)
    differences.table.columns.push_back({measure_title(measure), "", Align::Point});
  for (auto& [row, numbers] : rows) {
    for (std::size_t i = 0; i < compared.size(); ++i) {
      const std::string mark = significance(numbers[i], limit);
      differences.any_marked = differences.any_marked || !mark.empty();
      row.entries.push_back(entry_of(numbers[i], compared[i]) + mark);
    }
    differences.table.rows.push_back(std::move(row));
  }
  return differences;
}

Failures failures_of(const Summary& summary, const SummaryChoice& choice, std::size_t method) {
  const Schema& schema = summary.header.schema;
  Failures sum;
  sum.by_status.resize(schema.statuses);
  for (const std::size_t cell : choice.cells) {
    const Statistics& statistics = summary.of(cell, method);
    if (statistics.events.empty() || statistics.trials == 0) continue;
    const std::uint64_t failed = failed_trials(schema, statistics);
    sum.trials += statistics.trials;
    sum.failed += failed;
    for (std::size_t s = 0; s < schema.statuses; ++s) sum.by_status[s] += statistics.events[s];
    const double rate = static_cast<double>(failed) / static_cast<double>(statistics.trials);
    if (rate <= sum.worst_rate) continue;
    sum.worst_rate = rate;
    sum.worst_cell = cell;
  }
  return sum;
}

FittedTable failure_table(const Summary& summary, const SummaryChoice& choice) {
  const Header& header = summary.header;
  FittedTable table;
  table.groups.emplace_back();
  table.label = "method";
  table.columns = {{"failed", "", Align::Right}, {"trials", "", Align::Right}, {"rate [95 %]", "", Align::Point}};
  const std::vector<std::size_t> axes = varying_axes(header, choice.cells);
  table.columns.push_back({"how", "", Align::Left});
  if (!axes.empty()) table.columns.push_back({"most in one cell", "", Align::Left});
  for (const std::size_t m : choice.methods) {
    if (!is_solver(summary, m)) continue;
    const Failures failures = failures_of(summary, choice, m);
    FittedTable::Row row{0, header.methods[m].label, {}};
    row.entries = {fmt::format("{}", failures.failed), fmt::format("{}", failures.trials),
                   rate_text(failures.failed, failures.trials)};
    row.entries.push_back(reasons_text(header.schema, failures));
    if (!axes.empty()) {
      row.entries.push_back(failures.failed == 0 ? ""
                                                 : fmt::format("{:.2g}: {}", failures.worst_rate,
                                                               axes_text(header, axes, failures.worst_cell)));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<std::size_t> varying_axes(const Header& header, const std::vector<std::size_t>& cells) {
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < header.axes.size(); ++axis) {
    const auto value = [&](std::size_t cell) { return header.cells[cell].indices[axis]; };
    if (std::ranges::any_of(cells, [&](std::size_t cell) { return value(cell) != value(cells.front()); }))
      axes.push_back(axis);
  }
  return axes;
}

std::string axes_text(const Header& header, const std::vector<std::size_t>& axes, std::size_t cell) {
  std::vector<std::string> texts;
  for (const std::size_t axis : axes) {
    const FactorValue& value = header.axes[axis].values[header.cells[cell].indices[axis]];
    texts.push_back(fmt::format("{} = {}", header.axes[axis].name, factor_text(value)));
  }
  return fmt::format("{}", fmt::join(texts, ", "));
}

}  // namespace ridgeloc::results
