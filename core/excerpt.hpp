#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "core/printable.hpp"

namespace ridgeloc::core {

/// A text of the user as messages echo it, in one line: its first 60 bytes at most, whole characters of UTF-8, and
/// "..." for the rest.
inline std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::size_t end = std::min(text.size(), longest);
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  std::string line = printable(std::string(text.substr(0, end)));
  std::ranges::replace_if(
      line, [](char c) { return c == '\n' || c == '\t'; }, ' ');
  return end < text.size() ? line + "..." : line;
}

}  // namespace ridgeloc::core
