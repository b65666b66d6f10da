#include "results/tables/summary_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <ostream>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "results/schema/text.hpp"
#include "results/summary/ratio.hpp"
#include "results/summary/summary_columns.hpp"
#include "results/util/json.hpp"

namespace ridgeloc::results {

namespace {

std::string value_json(const FactorValue& value) {
  const std::string text = factor_text(value);
  return std::holds_alternative<std::string>(value) ? json_string(text) : text;
}

std::string axis_json(const Axis& axis) {
  std::vector<std::string> values;
  for (const FactorValue& value : axis.values) values.push_back(value_json(value));
  return fmt::format("{{\"name\": {}, \"unit\": {}, \"description\": {}, \"values\": [{}]}}", json_string(axis.name),
                     json_string(axis.unit), json_string(axis.description), fmt::join(values, ", "));
}

std::string row_json(const Header& header, const SummaryRow& row) {
  std::vector<std::string> factors;
  for (std::size_t axis = 0; axis < header.axes.size(); ++axis) {
    factors.push_back(json_string(header.axes[axis].name) + ": " +
                      value_json(header.axes[axis].values[header.cells[row.cell].indices[axis]]));
  }
  std::string text = fmt::format(
      "{{\"cell\": {{{}}}, \"method\": {}, \"metric\": {}, \"unit\": {}, \"n\": {}, \"trusted\": {}, \"beyond\": {}",
      fmt::join(factors, ", "), json_string(header.methods[row.method].label), json_string(row.metric),
      json_string(row.unit), row.n, row.trusted, row.beyond);
  const auto add = [&](const auto& columns) {
    for (const auto& [name, value] : columns) text += fmt::format(", \"{}\": {}", name, json_number(row.*value));
  };
  add(summary_columns);
  add(summary_bar_columns);
  return text + fmt::format(", \"rms_trusted\": {}}}", row.rms_trusted);
}

std::string list(const std::vector<std::string>& items) {
  return items.empty() ? "[]" : fmt::format("[\n    {}\n  ]", fmt::join(items, ",\n    "));
}

}  // namespace

void write_summary_json(const Summary& of_methods, std::ostream& out) {
  const Summary summary = with_ratios(of_methods);
  const Header& header = summary.header;
  std::vector<std::string> axes;
  for (const Axis& axis : header.axes) axes.push_back(axis_json(axis));
  std::vector<std::string> methods;
  for (const MethodInfo& method : header.methods) {
    methods.push_back(fmt::format("{{\"label\": {}, \"description\": {}}}", json_string(method.label),
                                  json_string(method.description)));
  }
  std::vector<std::string> rows;
  for (const SummaryRow& row : summary_rows(summary)) rows.push_back(row_json(header, row));
  out << fmt::format(
      "{{\n  \"title\": {},\n  \"experiment\": {},\n  \"experiment_version\": {},\n  \"study_hash\": {},\n  \"seed\": "
      "{},\n"
      "  \"trials\": {},\n  \"sealed\": {},\n  \"isa\": {},\n  \"axes\": {},\n  \"methods\": {},\n  \"rows\": {}\n}}\n",
      json_string(header.title), json_string(header.experiment), header.experiment_version,
      json_string(header.study_hash), header.seed, header.trials, summary.is_sealed, json_string(header.isa),
      list(axes), list(methods), list(rows));
  if (!out.flush()) throw core::IoError("cannot write the JSON output: is the disk full or the reader gone?");
}

}  // namespace ridgeloc::results
