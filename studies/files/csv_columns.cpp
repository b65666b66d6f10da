#include "studies/files/csv_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>

#include "core/error.hpp"
#include "core/excerpt.hpp"
#include "studies/files/csv_rows.hpp"
#include "studies/files/text_file.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::studies {

namespace {

/// A measurement of a hundred thousand rows with many columns.
constexpr std::size_t most_mib = 256;

/// Where a column stands in the first line.
std::size_t position_of(const std::string& column, const std::vector<std::string>& names, const std::string& place) {
  const auto found = std::ranges::find(names, column);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string nearest = core::excerpt(nearest_name(column, names));
  std::vector<std::string> shown;
  for (const std::string& name : names) shown.push_back(core::excerpt(name));
  throw core::InputError(fmt::format("{}: no column \"{}\"{}", place, core::excerpt(column),
                                     nearest.empty() ? fmt::format(" (there are: {})", fmt::join(shown, ", "))
                                                     : fmt::format(" (did you mean \"{}\"?)", nearest)));
}

}  // namespace

std::vector<std::vector<double>> read_csv_columns(const std::filesystem::path& path,
                                                  const std::vector<std::string>& columns, std::size_t most) {
  return columns_in(read_text_file(path, most_mib), path.string(), columns, most);
}

std::vector<std::vector<double>> columns_in(std::string text, const std::string& origin,
                                            const std::vector<std::string>& columns, std::size_t most) {
  std::istringstream stream(std::move(text));
  CsvRows rows(stream);
  const auto place = [&] { return fmt::format("{}:{}", origin, rows.line()); };

  std::vector<std::string> names;
  rows.next(names);
  std::vector<std::size_t> positions;
  for (const std::string& column : columns) positions.push_back(position_of(column, names, place()));
  std::vector<std::vector<double>> values(columns.size());
  std::vector<std::string> cells;
  for (std::size_t read = 0; read < most && rows.next(cells); ++read) {
    if (cells.size() > names.size()) {
      throw core::InputError(fmt::format("{}: {} cells where the first line names {}; is a comma the decimal point?",
                                         place(), cells.size(), names.size()));
    }
    if (rows.is_unclosed()) throw core::InputError(fmt::format("{}: a quote that is not closed", place()));
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string cell = positions[c] < cells.size() ? cells[positions[c]] : std::string();
      const auto value = rows.number_in(cell);
      if (!value)
        throw core::InputError(
            fmt::format("{}: \"{}\" in column \"{}\" is not a number", place(), core::excerpt(cell), columns[c]));
      values[c].push_back(*value);
    }
  }
  return values;
}

}  // namespace ridgeloc::studies
