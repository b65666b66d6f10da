#include "studies/measured/object_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/excerpt.hpp"
#include "studies/files/csv_rows.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::studies {

namespace {

/// Where a column stands, or nothing.
std::optional<std::size_t> find_column(const std::vector<std::string>& names, const std::string& column) {
  const auto found = std::ranges::find(names, column);
  if (found == names.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names.begin());
}

}  // namespace

ObjectTable read_objects(std::istream& text, const std::string& origin, const DataColumns& columns, double unit_m) {
  CsvRows rows(text);
  const auto place = [&] { return fmt::format("{}:{}", origin, rows.line()); };
  std::vector<std::string> names;
  rows.next(names);
  const DataColumns usual;
  // The data may call a column something else than the objects do.
  const auto find = [&](std::string DataColumns::*column) {
    const auto found = find_column(names, columns.*column);
    return found ? found : find_column(names, usual.*column);
  };
  const auto required = [&](std::string DataColumns::*column, const char* role) {
    if (const auto found = find(column)) return *found;
    throw core::InputError(fmt::format("{}: no column \"{}\" (there are: {}); --column {}=NAME says which it is",
                                       place(), columns.*column,
                                       core::excerpt(fmt::format("{}", fmt::join(names, ", "))), role));
  };
  const std::size_t object = required(&DataColumns::object, "object");
  const std::array<std::optional<std::size_t>, 3> coordinates = {required(&DataColumns::x, "x"),
                                                                 required(&DataColumns::y, "y"), find(&DataColumns::z)};
  ObjectTable objects;
  std::vector<std::string> cells;
  while (rows.next(cells)) {
    cells.resize(std::max(cells.size(), names.size()));
    Place at{};
    for (std::size_t axis = 0; axis < at.size(); ++axis) {
      if (!coordinates[axis]) continue;
      const std::string& cell = cells[*coordinates[axis]];
      const auto value = rows.number_in(cell);
      if (!value) {
        throw core::InputError(fmt::format("{}: \"{}\" in column \"{}\" is not a number", place(), core::excerpt(cell),
                                           names[*coordinates[axis]]));
      }
      at[axis] = *value * unit_m;
    }
    if (cells[object].empty()) throw core::InputError(fmt::format("{}: the object has no name", place()));
    if (!objects.emplace(cells[object], at).second)
      throw core::InputError(
          fmt::format("{}: object \"{}\" is there twice; leave one out", place(), core::excerpt(cells[object])));
  }
  if (objects.empty()) throw core::InputError(fmt::format("{}: no object", origin));
  return objects;
}

}  // namespace ridgeloc::studies
