#pragma once

#include <string>
#include <vector>

namespace ridgeloc::app {

/// Throws core::InputError, one line with the nearest name and all, if what an option gives is none of the names.
void check_name(const char* option, const std::string& name, const std::vector<std::string>& allowed);

}  // namespace ridgeloc::app
