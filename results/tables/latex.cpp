#include "results/tables/latex.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <optional>

#include "core/error.hpp"
#include "results/schema/text.hpp"
#include "results/summary/measure.hpp"
#include "results/summary/ranking.hpp"
#include "results/tables/latex_text.hpp"

namespace ridgeloc::results {
namespace {

/// More values of an axis than this have no room beside each other.
constexpr std::size_t most_columns = 8;

/// More lines than this have no room on a page, and the table goes on over several.
constexpr std::size_t most_lines = 40;

const char* statistic_text(Measure::Lead lead) {
  switch (lead) {
    case Measure::Lead::Mean:
      return "mean";
    case Measure::Lead::Median:
      return "median";
    case Measure::Lead::Rate:
      return "rate";
  }
  return "";
}

std::string line(const std::vector<std::string>& entries) {
  return fmt::format("    {} \\\\\n", fmt::join(entries, " & "));
}

/// "range noise in m"; the name where there is no description.
std::string with_unit(const std::string& name, const std::string& description, const std::string& unit) {
  const std::string what = description.empty() ? name : description;
  return unit == "1" || unit.empty() ? what : fmt::format("{} in {}", what, unit);
}

/// Methods, but no differences, that report it in any cell.
std::vector<std::size_t> reporting_methods(const Summary& summary, const Measure& measure) {
  std::vector<std::size_t> methods;
  for (std::size_t method = 0; method < summary.header.methods.size(); ++method) {
    if (summary.header.methods[method].difference) continue;
    for (std::size_t cell = 0; cell < summary.header.cells.size(); ++cell) {
      if (summary_row(summary.header, method, summary.of(cell, method), measure.name).n == 0) continue;
      methods.push_back(method);
      break;
    }
  }
  if (methods.empty()) throw core::InputError(fmt::format("no method reports {}", measure.name));
  return methods;
}

/// A table of one measure. Its columns are the values of an axis, or the methods where no axis has room; its rows all
/// else, methods last.
class Table {
 public:
  Table(const Summary& summary, const Measure& measure)
      : summary_(summary), header_(summary.header), measure_(measure), methods_(reporting_methods(summary, measure)) {
    const std::vector<Measure> ranking = ranking_measures(summary);
    is_ranked_ = std::ranges::find(ranking, measure.name, &Measure::name) != ranking.end();
    std::size_t most = 1;
    for (std::size_t axis = 0; axis < header_.axes.size(); ++axis) {
      const std::size_t values = header_.axes[axis].values.size();
      if (values <= most || values > most_columns) continue;
      most = values;
      column_axis_ = axis;
    }
    for (std::size_t cell = 0; cell < header_.cells.size(); ++cell) {
      for (const std::size_t method : methods_) {
        Key row;
        for (std::size_t axis = 0; axis < header_.axes.size(); ++axis)
          if (axis != column_axis_) row.push_back(header_.cells[cell].indices[axis]);
        if (column_axis_) row.push_back(method);
        const std::size_t column = column_axis_ ? header_.cells[cell].indices[*column_axis_] : method;
        entries_[row][column] = entry(cell, method);
      }
    }
  }

  std::string text(const LatexSource& source) const {
    const std::size_t leading = entries_.begin()->first.size();
    const std::vector<std::size_t> columns = all_columns();
    const std::string alignment = std::string(leading, 'l') + std::string(columns.size(), 'r');
    const std::string head = heading(leading, columns);
    const std::string about = fmt::format("\\caption{{{}}}", caption(source.digest));
    const std::string label = fmt::format("\\label{{tab:{}}}", latex_label(measure_.name));
    if (entries_.size() > most_lines) {
      return fmt::format(
          "\n\\begin{{longtable}}{{{}}}\n  {}\n  {} \\\\\n    \\toprule\n{}    \\midrule\n  \\endhead\n    "
          "\\bottomrule\n  \\endfoot\n{}\\end{{longtable}}\n",
          alignment, about, label, head, body(columns));
    }
    return fmt::format(
        "\n\\begin{{table}}\n  \\centering\n  {}\n  {}\n  \\begin{{tabular}}{{{}}}\n    \\toprule\n{}    "
        "\\midrule\n{}    \\bottomrule\n  \\end{{tabular}}\n\\end{{table}}\n",
        about, label, alignment, head, body(columns));
  }

  bool is_long() const { return entries_.size() > most_lines; }

 private:
  using Key = std::vector<std::size_t>;

  std::string entry(std::size_t cell, std::size_t method) {
    const SummaryRow row = summary_row(header_, method, summary_.of(cell, method), measure_.name);
    if (row.n == 0) return "--";
    const std::string text = latex_number(row, measure_.lead);
    any_untrusted_ = any_untrusted_ || text.ends_with("^{!}");
    if (!is_best(cell, method)) return fmt::format("${}$", text);
    any_best_ = true;
    return fmt::format("$\\mathbf{{{}}}$", text);
  }

  /// Whether the method is significantly the best of its cell.
  bool is_best(std::size_t cell, std::size_t method) const {
    if (!is_ranked_) return false;
    const auto ranking = ranking_of(summary_, cell, methods_, measure_);
    return ranking && ranking->best == method && ranking->is_significant();
  }

  std::vector<std::size_t> all_columns() const {
    if (!column_axis_) return methods_;
    std::vector<std::size_t> columns(header_.axes[*column_axis_].values.size());
    std::iota(columns.begin(), columns.end(), std::size_t{0});
    return columns;
  }

  std::string heading(std::size_t leading, const std::vector<std::size_t>& columns) const {
    std::vector<std::string> heads;
    for (std::size_t axis = 0; axis < header_.axes.size(); ++axis) {
      if (axis == column_axis_) continue;
      const Axis& a = header_.axes[axis];
      heads.push_back(latex_head(with_unit(a.name, a.description, a.unit)));
    }
    if (!column_axis_) {
      for (const std::size_t method : columns) heads.push_back(latex_text(header_.methods[method].label));
      return line(heads);
    }
    heads.emplace_back("method");
    const Axis& across = header_.axes[*column_axis_];
    for (const std::size_t value : columns) heads.push_back(latex_text(factor_text(across.values[value])));
    std::vector<std::string> above(leading);
    above.push_back(fmt::format("\\multicolumn{{{}}}{{c}}{{{}}}", columns.size(),
                                latex_text(with_unit(across.name, across.description, across.unit))));
    return line(above) + fmt::format("    \\cmidrule(lr){{{}-{}}}\n", leading + 1, leading + columns.size()) +
           line(heads);
  }

  /// A value that is that of the line above is not said again.
  std::string body(const std::vector<std::size_t>& columns) const {
    std::string text;
    const Key* above = nullptr;
    for (const auto& [row, entries] : entries_) {
      std::vector<std::string> cells;
      bool is_new = above == nullptr;
      std::size_t i = 0;
      for (std::size_t axis = 0; axis < header_.axes.size(); ++axis) {
        if (axis == column_axis_) continue;
        is_new = is_new || (*above)[i] != row[i];
        cells.push_back(is_new ? latex_text(factor_text(header_.axes[axis].values[row[i]])) : "");
        ++i;
      }
      if (column_axis_) {
        if (above != nullptr && i > 0 && is_new) text += "    \\addlinespace\n";
        cells.push_back(latex_text(header_.methods[row.back()].label));
      }
      for (const std::size_t column : columns) {
        const auto found = entries.find(column);
        cells.push_back(found == entries.end() ? "" : found->second);
      }
      text += line(cells);
      above = &row;
    }
    return text;
  }

  std::string caption(const std::string& digest) const {
    const std::string title = header_.title.empty() ? header_.experiment : header_.title;
    std::string text =
        fmt::format("{}: {}, {}. In parentheses the standard error of the last digits.", title,
                    with_unit(measure_.name, measure_.description, measure_.unit), statistic_text(measure_.lead));
    if (any_untrusted_) text += " !: the error itself is not reliable.";
    if (any_best_) text += " Bold: significantly the best method, at 5 % for each cell.";
    text += fmt::format(" {} trials per cell, seed {}, {}.", header_.trials, header_.seed,
                        digest.empty() ? "incomplete" : fmt::format("data {}", digest.substr(0, 12)));
    return latex_text(text);
  }

  const Summary& summary_;
  const Header& header_;
  const Measure& measure_;
  std::vector<std::size_t> methods_;
  std::optional<std::size_t> column_axis_;
  std::map<Key, std::map<std::size_t, std::string>> entries_;  ///< by row and column
  bool is_ranked_ = false;
  bool any_untrusted_ = false;
  bool any_best_ = false;
};

}  // namespace

std::vector<std::string> leading_quantities(const Header& header) {
  std::vector<std::string> names = drawn_measures(header);
  if (!names.empty()) return names;
  if (!header.schema.metrics.empty()) names.push_back(header.schema.metrics.front().name);
  if (!header.schema.events.empty()) names.push_back(header.schema.events.front().name);
  return names;
}

std::string latex_tables(const Summary& summary, const std::vector<std::string>& quantities,
                         const LatexSource& source) {
  const std::vector<Measure> measures = measures_of(summary.header.schema);
  std::string tables;
  bool any_long = false;
  for (const std::string& name : quantities) {
    const auto measure = std::ranges::find(measures, name, &Measure::name);
    if (measure == measures.end())
      throw core::InputError(fmt::format("the result has no metric or event \"{}\"", name));
    const Table table(summary, *measure);
    tables += table.text(source);
    any_long = any_long || table.is_long();
  }
  std::string command = source.command;
  std::ranges::replace_if(
      command, [](unsigned char c) { return c < 0x20; }, ' ');
  return fmt::format("% {}\n% \\usepackage{{booktabs{}}}\n", command, any_long ? ",longtable" : "") + tables;
}

}  // namespace ridgeloc::results
