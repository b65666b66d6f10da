#pragma once

#include <span>
#include <string_view>

namespace ridgeloc::studies {

/// A study that comes with the program.
struct CatalogEntry {
  std::string_view name;
  std::string_view text;  ///< the study file
};

std::span<const CatalogEntry> catalog();

/// The entry of that name, or null.
const CatalogEntry* find_in_catalog(std::string_view name);

}  // namespace ridgeloc::studies
