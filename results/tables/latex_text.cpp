#include "results/tables/latex_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "results/schema/text.hpp"
#include "results/statistics/interval.hpp"

namespace ridgeloc::results {
namespace {

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

}  // namespace

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

std::string latex_number(const SummaryRow& row, Measure::Lead lead) {
  constexpr double interval_errors = 2.0 * normal_quantile_975;
  switch (lead) {
    case Measure::Lead::Median:
      return number(text_with_digits(row.p50, (row.p50_hi - row.p50_lo) / interval_errors));
    case Measure::Lead::Rate:
      return number(text_with_digits(row.mean, (row.hi - row.lo) / interval_errors));
    case Measure::Lead::Mean:
      break;
  }
  return number(text_with_digits(row.mean, row.mcse)) + (row.trusted ? "" : "^{!}");
}

std::string latex_head(const std::string& text) {
  constexpr std::size_t longest = 20;
  if (text.size() <= longest) return latex_text(text);
  return fmt::format("\\multicolumn{{1}}{{p{{2.6cm}}}}{{\\raggedright {}}}", latex_text(text));
}

std::string latex_label(const std::string& name) {
  std::string label;
  for (const char c : name) label += std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' ? c : '-';
  return label;
}

}  // namespace ridgeloc::results
