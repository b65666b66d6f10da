#pragma once

#include <span>

#include "studies/catalog/catalog.hpp"

namespace ridgeloc::studies {

/// Maps of buildings that come with the program, as files.
std::span<const CatalogEntry> building_maps();

}  // namespace ridgeloc::studies
