#pragma once

#include <string_view>

#include "studies/study/value.hpp"

namespace ridgeloc::studies {

/// The map of that name that comes with the program, or null.
const Building* find_building(std::string_view name);

}  // namespace ridgeloc::studies
