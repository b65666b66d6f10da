#pragma once

#include <string>
#include <string_view>

namespace ridgeloc::results {

/// Runs a gnuplot script, without the user's own gnuplot settings.
///
/// Throws core::InputError if gnuplot is not installed and core::IoError with gnuplot's message if it fails.
void run_gnuplot(const std::string& script);

/// A gnuplot string constant that shows `text` as it is: in double quotes, every ASCII character but letters, digits
/// and spaces as an octal escape, so that no quote, backquote, macro or comment can be read into it; control characters
/// become spaces. For texts that gnuplot takes as a number format (tick labels), see `gnuplot_tick_label`.
std::string gnuplot_string(std::string_view text);

/// The same for an explicit tick label, where gnuplot reads % as the start of a number format.
std::string gnuplot_tick_label(std::string_view text);

}  // namespace ridgeloc::results
