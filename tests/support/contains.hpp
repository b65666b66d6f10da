#pragma once

#include <string_view>

namespace ridgeloc::tests {

inline bool contains(std::string_view text, std::string_view piece) {
  return text.find(piece) != std::string_view::npos;
}

}  // namespace ridgeloc::tests
