#pragma once

// Internal to studies: what is looked at in a TOML text before it is parsed.

#include <cstddef>
#include <optional>
#include <string_view>

namespace ridgeloc::studies {

/// Parts that a dotted key may have. The parser makes a table within a table for each, without a limit of its own, and
/// such tables come to the end of the stack when they are destroyed.
inline constexpr std::size_t most_key_parts = 100;

/// The line, from 1, of the first dotted key that has more; none in a text without such a key.
std::optional<std::size_t> line_of_deep_key(std::string_view text);

}  // namespace ridgeloc::studies
