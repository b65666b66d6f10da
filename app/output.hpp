#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>

namespace ridgeloc::app {

/// What a link stands for, which may not be there yet; any other path as it is. A file that is written under another
/// name and renamed would otherwise take the place of the link.
std::filesystem::path link_target(const std::filesystem::path& path);

/// Writes text to standard output, or, where a path is given, to a file that appears complete or not at all (a device
/// or a pipe is written to as it is). Throws core::InputError if the file cannot be written there, core::IoError if
/// writing fails.
void write_output(const std::string& path, const std::function<void(std::ostream&)>& write);

/// Makes a folder if it is not there; its parent must be. Throws core::InputError.
void require_folder(const std::filesystem::path& folder);

/// Whether a file or folder of that name is there; a name that cannot be asked for counts as absent.
bool path_exists(const std::filesystem::path& path);

/// Hands everything printed so far to the system. Throws core::IoError if some of it could not be written.
void finish_standard_output();

}  // namespace ridgeloc::app
