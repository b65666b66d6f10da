#pragma once

#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

#include "core/error.hpp"

namespace ridgeloc::app {

/// Makes standard input, output and error safe to use, whatever the program was started with: those that are closed are
/// opened on the null device, so that no file of the program takes their place, and a reader that goes away is an error
/// of writing instead of a signal. Output that was closed stays one that cannot be written.
void prepare_standard_streams();

/// Writes text to standard error, as it is, if that can be: nothing that is only said may end what is computed.
void say(std::string_view text) noexcept;

/// What a link stands for, which may not be there yet; any other path as it is. A file that is written under another
/// name and renamed would otherwise take the place of the link. Throws core::InputError for links that lead in a
/// circle.
std::filesystem::path link_target(const std::filesystem::path& path);

/// Writes text to standard output, or, where a path is given, to a file that appears complete or not at all (a device
/// or a pipe is written to as it is). Throws core::InputError if the file cannot be written there, core::IoError if
/// writing fails.
void write_output(const std::string& path, const std::function<void(std::ostream&)>& write);

/// Makes a folder if it is not there; its parent must be. Throws core::InputError.
void require_folder(const std::filesystem::path& folder);

/// Standard output could not be written.
class OutputLost : public core::IoError {
 public:
  OutputLost() : core::IoError("standard output cannot be written; is the disk full or the reader gone?") {}
};

/// Hands everything printed so far to the system. Throws OutputLost if some of it could not be written.
void finish_standard_output();

/// Whether nobody reads standard output any more: a pipe whose other end is closed.
bool is_reader_gone();

}  // namespace ridgeloc::app
