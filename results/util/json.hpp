#pragma once

#include <string>
#include <string_view>

namespace ridgeloc::results {

/// A text as a JSON string, quotes included. Precondition: UTF-8.
std::string json_string(std::string_view text);

/// A number in its shortest form that reads back as the same bits; null for what JSON has no number for.
std::string json_number(double value);

}  // namespace ridgeloc::results
