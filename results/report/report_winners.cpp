#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "results/report/html.hpp"
#include "results/report/report_part.hpp"
#include "results/summary/ranking.hpp"

namespace ridgeloc::results {
namespace {

using Kind = HtmlTable::Kind;

/// Solvers that report the measure in any cell.
std::vector<std::size_t> ranked_methods(const ReportSource& source, const Measure& measure) {
  std::vector<std::size_t> methods;
  for (const SummaryRow& row : source.rows) {
    const bool counts = row.metric == measure.name && row.n > 0 && is_solver(source.summary, row.method) &&
                        !source.summary.header.methods[row.method].difference;
    if (counts && std::ranges::find(methods, row.method) == methods.end()) methods.push_back(row.method);
  }
  std::ranges::sort(methods);
  return methods;
}

HtmlCell ranked_cell(const SummaryRow& row, const Measure& measure, const std::optional<Ranking>& ranking) {
  const std::string text = html_text(estimate_text(row, measure.lead));
  const std::string key = fmt::format("{}", measure.lead == Measure::Lead::Median ? row.p50 : row.mean);
  if (!ranking || row.n == 0) return {text, key};
  if (row.method == ranking->best)
    return {fmt::format("<b class=\"best\">{}{}</b>", text, ranking->is_significant() ? " *" : ""), key};
  const bool is_rival = std::ranges::find(ranking->rivals, row.method) != ranking->rivals.end();
  return {is_rival ? text + " ≈" : text, key};
}

/// In how many cells each method is best, and in how many not shown to be worse.
std::string tally(const Header& header, const std::vector<std::size_t>& methods,
                  const std::vector<std::optional<Ranking>>& rankings) {
  std::string items;
  for (const std::size_t method : methods) {
    const auto cells = [&](auto holds) {
      return std::ranges::count_if(rankings, [&](const auto& ranking) { return ranking && holds(*ranking); });
    };
    const auto wins = cells([&](const Ranking& r) { return r.best == method; });
    const auto clear = cells([&](const Ranking& r) { return r.best == method && r.is_significant(); });
    const auto ties = cells([&](const Ranking& r) { return std::ranges::find(r.rivals, method) != r.rivals.end(); });
    items += fmt::format("<li>{}: best in {} of {} cells, significantly in {}; not shown to be worse in {} more</li>\n",
                         html_text(header.methods[method].label), wins, rankings.size(), clear, ties);
  }
  return "<ul>\n" + items + "</ul>\n";
}

}  // namespace

std::string report_winners(const ReportSource& source, const ReportPlace&) {
  const Header& header = source.summary.header;
  const std::optional<Measure> measure = ranking_measure(source.summary);
  if (!measure) return "<p>The experiment has no measure by which methods are ranked.</p>\n";
  const std::vector<std::size_t> methods = ranked_methods(source, *measure);
  if (methods.size() < 2) return "<p>There are no two methods to compare.</p>\n";

  std::vector<HtmlTable::Column> columns = factor_columns(header);
  for (const std::size_t method : methods) columns.push_back({header.methods[method].label, Kind::Number});
  HtmlTable table(fmt::format("{}: {}", measure_title(*measure), estimate_kind(measure->lead)), columns);
  std::vector<std::optional<Ranking>> rankings;
  bool all_trials = true;
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
    rankings.push_back(ranking_of(source.summary, cell, methods, *measure));
    std::vector<HtmlCell> cells = factor_cells(header, cell);
    for (const std::size_t method : methods) {
      const Statistics& statistics = source.summary.of(cell, method);
      SummaryRow row = summary_row(header, method, statistics, measure->name);
      all_trials = all_trials && row.n == statistics.trials;
      cells.push_back(ranked_cell(row, *measure, rankings.back()));
    }
    table.add(cells);
  }
  const std::string population =
      all_trials ? "" : " Not all trials have a value; what failed is under Failures and not in these numbers.";
  return fmt::format(
             "<p>{} The smallest number of a cell is bold. * means that it is significantly the best: all others are "
             "larger in the mean, by differences of the same trials where the study compares the two{}, at 5 % for the "
             "cell as a whole. ≈ marks what is not shown to be worse than the best.{}</p>\n",
             html_text(sentence(measure->description)),
             measure->lead == Measure::Lead::Median ? ", or in the median" : "", population) +
         tally(header, methods, rankings) + table.html();
}

}  // namespace ridgeloc::results
