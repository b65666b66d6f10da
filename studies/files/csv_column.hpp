#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ridgeloc::studies {

/// Reads numbers of one column of a CSV file: commas, or semicolons and decimal commas, a first line with names, quotes
/// where a cell needs them; empty lines are skipped. Stops after `most` numbers. Throws core::InputError: one line with
/// file and line, for a column that is not there with the nearest name.
std::vector<double> read_csv_column(const std::filesystem::path& path, const std::string& column, std::size_t most);

}  // namespace ridgeloc::studies
