#pragma once

#include <functional>
#include <iosfwd>
#include <string>

namespace ridgeloc::app {

/// Writes text to standard output, or, where a path is given, to a file that appears complete or not at all.
/// Throws core::InputError if the file cannot be written there, core::IoError if writing fails.
void write_output(const std::string& path, const std::function<void(std::ostream&)>& write);

}  // namespace ridgeloc::app
