#pragma once

#include <span>
#include <string_view>

#include "studies/catalog.hpp"
#include "studies/value.hpp"

namespace ridgeloc::studies {

/// Maps of buildings that come with the program, as files.
std::span<const CatalogEntry> building_maps();

/// The map of that name, or null.
const Building* find_building(std::string_view name);

}  // namespace ridgeloc::studies
