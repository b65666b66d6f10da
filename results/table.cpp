#include "results/table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <vector>

#include "results/text.hpp"

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

bool is_event(const Schema& schema, const std::string& name) {
  return std::any_of(schema.events.begin(), schema.events.end(),
                     [&](const EventInfo& event) { return event.name == name; });
}

struct Block {
  std::size_t cell = 0;
  std::size_t method = 0;
  std::vector<Cells> lines;
};

std::vector<Block> blocks_of(const Summary& summary) {
  std::vector<Block> blocks;
  bool in_events = false;
  for (const SummaryRow& row : summary_rows(summary)) {
    if (blocks.empty() || blocks.back().cell != row.cell || blocks.back().method != row.method) {
      blocks.push_back({row.cell, row.method, {}});
      in_events = false;
    }
    std::vector<Cells>& lines = blocks.back().lines;
    const bool event = is_event(summary.header.schema, row.metric);
    if (lines.empty() || event != in_events) lines.push_back(event ? event_head : metric_head);
    in_events = event;
    lines.push_back(event ? event_cells(row) : metric_cells(row));
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

std::string heading(const Header& header) {
  return fmt::format(
      "{}\n"
      "experiment {} (version {}), seed {}, {} trials per cell, study {}\n"
      "error: Monte Carlo standard error; [95 %]: 95 % interval; p05 .. p95: where 90 % of the trials lie\n"
      "n = a+b: b values are infinite or above 1e6; they enter the median and p05 .. p95, not the mean\n"
      "!: the error itself is not reliable (fewer than 10 values or outcomes of a kind, heavy tails, or b > "
      "0)\n"
      "Cells that share trials are not independent.\n",
      header.title.empty() ? header.experiment : header.title, header.experiment, header.experiment_version,
      header.seed, header.trials, header.study_hash.substr(0, 16));
}

}  // namespace

std::string summary_table(const Summary& summary) {
  const std::vector<Block> blocks = blocks_of(summary);
  std::array<std::size_t, columns> widths{};
  for (const Block& block : blocks) {
    for (const Cells& cells : block.lines) {
      for (std::size_t c = 0; c < columns; ++c) widths[c] = std::max(widths[c], display_width(cells[c]));
    }
  }
  std::string text = heading(summary.header);
  for (const Block& block : blocks) {
    const std::string cell = cell_text(summary.header, block.cell);
    text += fmt::format("\n{}{}{}\n", cell, cell.empty() ? "" : ": ", summary.header.methods[block.method].label);
    for (const Cells& cells : block.lines) text += line_text(cells, widths);
  }
  return text;
}

}  // namespace ridgeloc::results
