#include "results/tables/table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <vector>

#include "results/schema/text.hpp"
#include "results/statistics/interval.hpp"
#include "results/summary/completeness.hpp"
#include "results/summary/ratio.hpp"

namespace ridgeloc::results {
namespace {

constexpr std::size_t columns = 5;
using Cells = std::array<std::string, columns>;

const Cells metric_head = {"metric [unit]", "n", "mean ± error", "median [95 %]", "p05 .. p95"};
const Cells event_head = {"outcome", "n", "rate [95 %]", "count", ""};

std::string flagged(std::string text, const SummaryRow& row) {
  return row.trusted || row.n == 0 ? text : text + " !";
}

std::string population_text(const SummaryRow& row) {
  if (row.beyond == 0) return fmt::format("{}", row.n);
  return fmt::format("{}+{}", row.n - row.beyond, row.beyond);
}

Cells metric_cells(const SummaryRow& row) {
  const std::string range = row.p05 == row.p05 ? fmt::format("{:.3g} .. {:.3g}", row.p05, row.p95) : "-";
  return {row.unit == "1" ? row.metric : fmt::format("{} [{}]", row.metric, row.unit), population_text(row),
          flagged(text_with_error(row.mean, row.mcse), row), text_with_interval(row.p50, row.p50_lo, row.p50_hi),
          range};
}

Cells event_cells(const SummaryRow& row) {
  const std::string count = row.n == 0 ? "-" : fmt::format("{:.0f}", row.mean * static_cast<double>(row.n));
  return {row.metric, population_text(row), flagged(text_with_interval(row.mean, row.lo, row.hi), row), count, ""};
}

/// A population of a yes-or-no metric can be small, so that none seen says little: then the bound stands for the
/// interval.
Cells yes_no_cells(const SummaryRow& row) {
  if (row.n == 0 || row.mean > 0.0) return event_cells(row);
  return {row.metric, population_text(row), fmt::format("0 [<= {:.2g}]", upper_bound_of_none(row.n)), "0", ""};
}

enum class LineKind { Metric, YesNo, Event };

LineKind kind_of(const Schema& schema, const std::string& name) {
  for (const MetricInfo& metric : schema.metrics) {
    if (metric.name == name) return metric.yes_no ? LineKind::YesNo : LineKind::Metric;
  }
  return LineKind::Event;
}

Cells line_cells(const SummaryRow& row, LineKind kind) {
  switch (kind) {
    case LineKind::YesNo:
      return yes_no_cells(row);
    case LineKind::Event:
      return event_cells(row);
    case LineKind::Metric:
      break;
  }
  return metric_cells(row);
}

struct Block {
  std::size_t cell = 0;
  std::size_t method = 0;
  std::vector<Cells> lines;
};

bool is_chosen(const Header& header, const SummaryChoice& choice, const SummaryRow& row) {
  const std::size_t method = header.methods[row.method].ratio.value_or(row.method);
  return std::ranges::binary_search(choice.cells, row.cell) && std::ranges::binary_search(choice.methods, method);
}

std::vector<Block> blocks_of(const Summary& summary, const SummaryChoice& choice) {
  std::vector<Block> blocks;
  bool in_rates = false;
  for (const SummaryRow& row : summary_rows(summary)) {
    if (!is_chosen(summary.header, choice, row)) continue;
    if (blocks.empty() || blocks.back().cell != row.cell || blocks.back().method != row.method) {
      blocks.push_back({row.cell, row.method, {}});
      in_rates = false;
    }
    std::vector<Cells>& lines = blocks.back().lines;
    const LineKind kind = kind_of(summary.header.schema, row.metric);
    const bool rate = kind != LineKind::Metric;
    if (lines.empty() || rate != in_rates) lines.push_back(rate ? event_head : metric_head);
    in_rates = rate;
    lines.push_back(line_cells(row, kind));
  }
  return blocks;
}

std::string line_text(const Cells& cells, const std::array<std::size_t, columns>& widths) {
  std::string line;
  for (std::size_t c = 0; c < columns; ++c) {
    const std::string padding(widths[c] - display_width(cells[c]), ' ');
    const bool right = c == 1;
    line += "  " + (right ? padding + cells[c] : cells[c] + padding);
  }
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string table_heading(const Header& header) {
  const bool any_yes_no = std::ranges::any_of(header.schema.metrics, &MetricInfo::yes_no);
  return fmt::format(
      "{}\n"
      "experiment {} (version {}), seed {}, {} trials per cell, study {}\n"
      "error: Monte Carlo standard error; [95 %]: 95 % interval; p05 .. p95: where 90 % of the trials lie\n"
      "n = a+b: b values are infinite or above 1e6; they enter the median and p05 .. p95, not the mean\n"
      "!: the error itself is not reliable (fewer than 10 values or outcomes of a kind, heavy tails, or b > "
      "0)\n"
      "{}Cells that share trials are not independent.\n",
      header.title.empty() ? header.experiment : header.title, header.experiment, header.experiment_version,
      header.seed, header.trials, header.study_hash.substr(0, 16),
      any_yes_no ? "0 [<= u]: not seen once; with 95 % confidence the rate is at most u = 3 / n\n" : "");
}

}  // namespace

std::string summary_table(const Summary& of_methods) {
  return summary_table(of_methods, whole(of_methods.header));
}

std::string summary_table(const Summary& of_methods, const SummaryChoice& choice) {
  const Summary summary = with_ratios(of_methods);
  const std::vector<Block> blocks = blocks_of(summary, choice);
  std::array<std::size_t, columns> widths{};
  for (const Block& block : blocks) {
    for (const Cells& cells : block.lines) {
      for (std::size_t c = 0; c < columns; ++c) widths[c] = std::max(widths[c], display_width(cells[c]));
    }
  }
  std::string text = table_heading(summary.header);
  if (!is_complete(of_methods)) text += completeness_text(of_methods) + "\n";
  for (const Block& block : blocks) {
    const std::string cell = cell_text(summary.header, block.cell);
    text += fmt::format("\n{}{}{}\n", cell, cell.empty() ? "" : ": ", summary.header.methods[block.method].label);
    for (const Cells& cells : block.lines) text += line_text(cells, widths);
  }
  return text;
}

}  // namespace ridgeloc::results
