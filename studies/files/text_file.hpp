#pragma once

// Internal to studies: whole text files.

#include <cstddef>
#include <filesystem>
#include <string>

namespace ridgeloc::studies {

/// Most that is read of a study or a map; those with all that is allowed are smaller.
inline constexpr std::size_t most_text_mib = 64;

/// The content of a file, or of a pipe up to its end. Throws core::InputError if it cannot be read or is larger than so
/// many MiB: what is given may be a device that never ends.
std::string read_text_file(const std::filesystem::path& path, std::size_t most_mib);

}  // namespace ridgeloc::studies
