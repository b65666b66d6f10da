#pragma once

#include <istream>
#include <map>
#include <string>

#include "studies/measured/data_columns.hpp"
#include "studies/measured/epoch.hpp"

namespace ridgeloc::studies {

/// Positions of objects by name (m).
using ObjectTable = std::map<std::string, Place, std::less<>>;

/// Reads objects from a CSV text: their name and their coordinates, z 0 where it has no such column, in `unit_m`
/// metres. `origin` is what messages call the text. Throws core::InputError: a line with file, line and what is wrong.
ObjectTable read_objects(std::istream& text, const std::string& origin, const DataColumns& columns, double unit_m);

}  // namespace ridgeloc::studies
