#pragma once

#include <cstddef>
#include <string>

namespace ridgeloc::core {

/// Whether a byte begins a control character of UTF-8, one that a terminal may take for a command; line feed and
/// tabulator are none. `next` is the byte behind it.
inline bool begins_control(unsigned char byte, unsigned char next) {
  if (byte == '\n' || byte == '\t') return false;
  const bool is_late = byte == 0xC2 && next >= 0x80 && next < 0xA0;  // U+0080 to U+009F
  return byte < 0x20 || byte == 0x7F || is_late;
}

/// A text with question marks for its control characters, so that who shows it is safe from whoever wrote it.
inline std::string printable(std::string text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (!begins_control(byte, next)) continue;
    if (byte == 0xC2) text.erase(i, 1);
    text[i] = '?';
  }
  return text;
}

}  // namespace ridgeloc::core
