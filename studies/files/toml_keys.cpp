#include "studies/files/toml_keys.hpp"

#include <algorithm>

namespace ridgeloc::studies {

namespace {

/// Where the string ends that begins at `begin` with a quote, one past its last one. A string without an end is the
/// parser's affair.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const bool is_long = text.size() - begin >= 3 && text[begin + 1] == quote && text[begin + 2] == quote;
  const std::size_t quotes = is_long ? 3 : 1;
  for (std::size_t i = begin + quotes; i < text.size(); ++i) {
    if (text[i] == '\\' && quote == '"') {
      ++i;
    } else if (!is_long && text[i] == '\n') {
      return i;
    } else if (text[i] == quote && (!is_long || text.substr(i, quotes) == text.substr(begin, quotes))) {
      return i + quotes;
    }
  }
  return text.size();
}

}  // namespace

std::optional<std::size_t> line_of_deep_key(std::string_view text) {
  constexpr std::string_view ends_of_keys = ",=[]{}\n";
  std::size_t parts = 1;
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'') {
      i = end_of_string(text, i);
      continue;
    }
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    if (ends_of_keys.find(c) != std::string_view::npos) parts = 1;
    if (c == '.' && ++parts > most_key_parts)
      return 1 +
             static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n'));
    ++i;
  }
  return std::nullopt;
}

}  // namespace ridgeloc::studies
