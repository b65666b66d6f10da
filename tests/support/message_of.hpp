#pragma once

#include <exception>
#include <string>
#include <vector>

#include "core/error.hpp"

namespace ridgeloc::tests {

/// What an exception of that type says; empty if none is thrown. Others pass.
template <class Exception = std::exception, class Action>
std::string message_of(Action&& action) {
  try {
    action();
  } catch (const Exception& error) {
    return error.what();
  }
  return {};
}

/// What is said to a user whose input is refused; empty if it is not.
template <class Action>
std::string refusal_of(Action&& action) {
  return message_of<core::InputError>(action);
}

/// The first of the phrases that a message lacks, with the message; empty if it has all of them in one line.
inline std::string lacking(const std::string& message, const std::vector<std::string>& phrases) {
  for (const std::string& phrase : phrases)
    if (message.find(phrase) == std::string::npos) return "no \"" + phrase + "\" in: " + message;
  return message.find('\n') == std::string::npos ? "" : "several lines: " + message;
}

}  // namespace ridgeloc::tests
