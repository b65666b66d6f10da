#include "results/tables/data_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "results/schema/text.hpp"
#include "results/util/json.hpp"

namespace ridgeloc::results {
namespace {

struct TextWriter {
  std::string operator()(std::monostate) const { return "-"; }
  std::string operator()(bool value) const { return value ? "yes" : "no"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return std::isnan(value) ? "nan" : fmt::format("{:.6g}", value); }
  std::string operator()(const std::string& value) const { return value; }
  std::string operator()(const std::vector<double>& values) const {
    std::string text;
    for (const double value : values) text += fmt::format("{}{:.4g}", text.empty() ? "" : " ", value);
    return text.empty() ? "-" : text;
  }
};

struct JsonWriter {
  std::string operator()(std::monostate) const { return "null"; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return json_number(value); }
  std::string operator()(const std::string& value) const { return json_string(value); }
  std::string operator()(const std::vector<double>& values) const {
    std::vector<std::string> numbers;
    for (const double value : values) numbers.push_back(json_number(value));
    return fmt::format("[{}]", fmt::join(numbers, ", "));
  }
};

bool is_text(const Field& field) {
  return std::holds_alternative<std::string>(field) || std::holds_alternative<std::vector<double>>(field);
}

/// One column of text, all lines equally wide: numbers to the right, texts and lists to the left.
std::vector<std::string> column_text(const DataTable& table, std::size_t column) {
  std::vector<std::string> lines = {table.columns[column]};
  for (const auto& row : table.rows) lines.push_back(std::visit(TextWriter{}, row[column]));
  std::size_t width = 0;
  for (const std::string& line : lines) width = std::max(width, display_width(line));
  const bool left = std::ranges::any_of(table.rows, [&](const auto& row) { return is_text(row[column]); });
  for (std::string& line : lines) {
    const std::string padding(width - display_width(line), ' ');
    line = left ? line + padding : padding + line;
  }
  return lines;
}

}  // namespace

std::string table_text(const DataTable& table) {
  std::vector<std::string> lines(table.rows.size() + 1);
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const bool empty = std::ranges::all_of(
        table.rows, [&](const auto& row) { return std::holds_alternative<std::monostate>(row[c]); });
    if (empty) continue;
    const auto column = column_text(table, c);
    for (std::size_t i = 0; i < lines.size(); ++i) lines[i] += "  " + column[i];
  }
  std::string text = table.name + "\n";
  for (const std::string& line : lines) text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  return text;
}

std::string table_json(const DataTable& table, std::size_t indent) {
  std::vector<std::string> rows;
  for (const auto& row : table.rows) {
    std::vector<std::string> members;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      members.push_back(fmt::format("{}: {}", json_string(table.columns[c]), std::visit(JsonWriter{}, row[c])));
    }
    rows.push_back(fmt::format("\n{:{}}{{{}}}", "", indent + 2, fmt::join(members, ", ")));
  }
  return rows.empty() ? "[]" : fmt::format("[{}\n{:{}}]", fmt::join(rows, ","), "", indent);
}

}  // namespace ridgeloc::results
