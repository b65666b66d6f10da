#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ridgeloc::studies {

/// Reads numbers of some columns of a CSV file, a list of each in the order of `columns`: a first line with names,
/// quotes where a cell needs them; empty lines are skipped. Cells are separated by commas, or, where the first line has
/// none, by semicolons or tabulators, and then a number may have a decimal comma. Stops after `most` rows. Throws
/// core::InputError: one line with file and line, for a column that is not there with the nearest name.
std::vector<std::vector<double>> read_csv_columns(const std::filesystem::path& path,
                                                  const std::vector<std::string>& columns, std::size_t most);

/// The same of a text, which messages call `origin`.
std::vector<std::vector<double>> columns_in(std::string text, const std::string& origin,
                                            const std::vector<std::string>& columns, std::size_t most);

}  // namespace ridgeloc::studies
