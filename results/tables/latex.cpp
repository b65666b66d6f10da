#include "results/tables/latex.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.hpp"
#include "results/schema/text.hpp"
#include "results/statistics/interval.hpp"

namespace ridgeloc::results {
namespace {

enum class Statistic { Mean, Median, Rate };

struct Quantity {
  std::string name;
  std::string description;
  std::string unit;
  Statistic statistic = Statistic::Mean;
};

Quantity quantity_named(const Schema& schema, const std::string& name) {
  using enum Statistic;
  const auto metric = std::ranges::find(schema.metrics, name, &MetricInfo::name);
  if (metric != schema.metrics.end()) {
    return {name, metric->description, metric->unit, metric->yes_no ? Rate : metric->heavy_tailed ? Median : Mean};
  }
  return {name, std::ranges::find(schema.events, name, &EventInfo::name)->description, "1", Rate};
}

const char* statistic_text(Statistic statistic) {
  switch (statistic) {
    case Statistic::Mean:
      return "mean";
    case Statistic::Median:
      return "median";
    case Statistic::Rate:
      return "rate";
  }
  return "";
}

/// A number as `text_with_digits` writes it, in mathematics.
std::string number(std::string text) {
  const auto replace = [&text](std::string_view piece, std::string_view by) {
    const std::size_t at = text.find(piece);
    if (at != std::string::npos) text.replace(at, piece.size(), by);
  };
  replace("inf", "\\infty");
  if (const std::size_t e = text.find('e'); e != std::string::npos) {
    const std::size_t end = std::min(text.find('(', e), text.size());
    text = fmt::format("{}\\times 10^{{{}}}{}", text.substr(0, e), std::stoi(text.substr(e + 1)), text.substr(end));
  }
  return text;
}

std::string entry(const SummaryRow& row, Statistic statistic) {
  if (row.n == 0) return "--";
  constexpr double interval_errors = 2.0 * normal_quantile_975;
  switch (statistic) {
    case Statistic::Median:
      return fmt::format("${}$", number(text_with_digits(row.p50, (row.p50_hi - row.p50_lo) / interval_errors)));
    case Statistic::Rate:
      return fmt::format("${}$", number(text_with_digits(row.mean, (row.hi - row.lo) / interval_errors)));
    case Statistic::Mean:
      break;
  }
  return fmt::format("${}{}$", number(text_with_digits(row.mean, row.mcse)), row.trusted ? "" : "^{!}");
}

std::string line(const std::vector<std::string>& entries) {
  return fmt::format("    {} \\\\\n", fmt::join(entries, " & "));
}

std::string caption(const Header& header, const Quantity& quantity, const std::string& digest) {
  const std::string title = header.title.empty() ? header.experiment : header.title;
  const std::string what = quantity.description.empty() ? quantity.name : quantity.description;
  const std::string unit = quantity.unit == "1" || quantity.unit.empty() ? "" : fmt::format(" in {}", quantity.unit);
  return latex_text(
      fmt::format("{}: {}{}, {}. In parentheses the standard error of the last digits. {} trials per "
                  "cell, seed {}, {}.",
                  title, what, unit, statistic_text(quantity.statistic), header.trials, header.seed,
                  digest.empty() ? "incomplete" : fmt::format("data {}", digest.substr(0, 12))));
}

/// Rows of one metric or event, by cell and, in these, by method.
std::vector<std::vector<SummaryRow>> rows_of(const Summary& summary, const std::vector<std::size_t>& methods,
                                             const std::string& name) {
  std::vector<std::vector<SummaryRow>> rows(summary.header.cells.size());
  for (std::size_t cell = 0; cell < rows.size(); ++cell) {
    for (const std::size_t method : methods) {
      rows[cell].push_back(summary_row(summary.header, method, summary.of(cell, method), name));
    }
  }
  return rows;
}

/// Methods, but no differences, that report it in any cell.
std::vector<std::size_t> reporting_methods(const Summary& summary, const std::string& name) {
  std::vector<std::size_t> methods;
  for (std::size_t method = 0; method < summary.header.methods.size(); ++method) {
    if (summary.header.methods[method].difference) continue;
    const auto rows = rows_of(summary, {method}, name);
    if (std::ranges::any_of(rows, [](const auto& row) { return row.front().n > 0; })) methods.push_back(method);
  }
  if (methods.empty()) throw core::InputError(fmt::format("no method reports {}", name));
  return methods;
}

std::string table(const Summary& summary, const Quantity& quantity, const LatexSource& source) {
  const Header& header = summary.header;
  const auto methods = reporting_methods(summary, quantity.name);
  const auto rows = rows_of(summary, methods, quantity.name);
  std::vector<std::string> heads;
  for (const Axis& axis : header.axes) heads.push_back(latex_text(axis.name));
  for (const std::size_t method : methods) heads.push_back(latex_text(header.methods[method].label));
  std::string body;
  bool any_untrusted = false;
  for (std::size_t cell = 0; cell < rows.size(); ++cell) {
    std::vector<std::string> entries;
    for (std::size_t axis = 0; axis < header.axes.size(); ++axis) {
      entries.push_back(latex_text(factor_text(header.axes[axis].values[header.cells[cell].indices[axis]])));
    }
    for (const SummaryRow& row : rows[cell]) {
      entries.push_back(entry(row, quantity.statistic));
      any_untrusted = any_untrusted || entries.back().find("^{!}") != std::string::npos;
    }
    body += line(entries);
  }
  return fmt::format(
      "\n\\begin{{table}}\n  \\centering\n  \\caption{{{}{}}}\n  \\label{{tab:{}}}\n"
      "  \\begin{{tabular}}{{{}}}\n    \\toprule\n{}    \\midrule\n{}    \\bottomrule\n"
      "  \\end{{tabular}}\n\\end{{table}}\n",
      caption(header, quantity, source.digest), any_untrusted ? " !: the error itself is not reliable." : "",
      quantity.name, std::string(heads.size(), 'r'), line(heads), body);
}

}  // namespace

std::vector<std::string> leading_quantities(const Header& header) {
  std::vector<std::string> names;
  for (const FigureSpec& figure : header.figures) {
    for (const std::string& name : figure.y) {
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    }
  }
  if (!names.empty()) return names;
  if (!header.schema.metrics.empty()) names.push_back(header.schema.metrics.front().name);
  if (!header.schema.events.empty()) names.push_back(header.schema.events.front().name);
  return names;
}

std::string latex_tables(const Summary& summary, const std::vector<std::string>& quantities,
                         const LatexSource& source) {
  std::string command = source.command;
  std::ranges::replace_if(
      command, [](unsigned char c) { return c < 0x20; }, ' ');
  std::string text = fmt::format("% {}\n% \\usepackage{{booktabs}}\n", command);
  for (const std::string& name : quantities) {
    text += table(summary, quantity_named(summary.header.schema, name), source);
  }
  return text;
}

std::string latex_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        result += '\\';
        result += c;
        break;
      case '~':
        result += "\\textasciitilde{}";
        break;
      case '^':
        result += "\\textasciicircum{}";
        break;
      case '\\':
        result += "\\textbackslash{}";
        break;
      case '<':
        result += "\\textless{}";
        break;
      case '>':
        result += "\\textgreater{}";
        break;
      case '|':
        result += "\\textbar{}";
        break;
      case '[':
      case '*':  // either would be an argument of the row before
        result += fmt::format("{{{}}}", c);
        break;
      default:
        result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return result;
}

}  // namespace ridgeloc::results
