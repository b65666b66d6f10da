#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace ridgeloc::tests {

/// Whether an action refuses its input as it should: by core::InputError, in one line. Anything else is found.
template <class Action>
bool is_refused(Action&& action) {
  try {
    action();
  } catch (const core::InputError& error) {
    if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    return true;
  }
  return false;
}

/// The input of a fuzzer as text.
inline std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

}  // namespace ridgeloc::tests
