#pragma once

#include <cstddef>
#include <string_view>

namespace ridgeloc::core {

/// How many single-character edits lie between two words (Levenshtein): used to name the nearest valid names.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace ridgeloc::core
