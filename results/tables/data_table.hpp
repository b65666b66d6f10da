#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ridgeloc::results {

/// What stands in a field of a table: nothing, yes or no, a number, a text, or several numbers.
using Field = std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>>;

/// A table of anything. Names are those of JSON, units included: "residual_rms_m".
struct DataTable {
  std::string name;
  std::vector<std::string> columns;
  std::vector<std::vector<Field>> rows;  ///< each as long as `columns`

  /// Appends a row, a field for each column.
  template <class... Fields>
  void add_row(Fields&&... fields) {
    std::vector<Field>& row = rows.emplace_back();
    row.reserve(sizeof...(fields));
    (row.emplace_back(std::forward<Fields>(fields)), ...);
  }
};

/// The table as people read it: the name, the columns' names and a line per row, aligned and indented by two spaces;
/// six significant digits, "-" where there is nothing. Columns that are empty in every row are left out.
std::string table_text(const DataTable& table);

/// The table as a JSON array of objects, one per line, each line after the first indented by `indent` spaces. Numbers
/// read back as the same bits; null where there is nothing, and for NaN and infinity.
std::string table_json(const DataTable& table, std::size_t indent);

}  // namespace ridgeloc::results
