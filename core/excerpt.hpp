#pragma once

#include <string>
#include <string_view>

namespace ridgeloc::core {

/// A text of the user as messages echo it: its first 60 bytes at most, whole characters of UTF-8, and "..." for the
/// rest.
inline std::string excerpt(std::string_view text) {
  constexpr std::size_t longest = 60;
  if (text.size() <= longest) return std::string(text);
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;
  return std::string(text.substr(0, end)) + "...";
}

}  // namespace ridgeloc::core
