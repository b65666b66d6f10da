#pragma once

#include <string>
#include <string_view>

namespace ridgeloc::results {

/// Text as one word of a POSIX shell: as it is where that is safe, else between single quotes.
std::string shell_word(std::string_view text);

}  // namespace ridgeloc::results
