#pragma once

#include <filesystem>

namespace ridgeloc::tests {

/// Calls every public reader of results and what verbs make of their answers. They may throw core::InputError and
/// nothing else.
void read_everything(const std::filesystem::path& result);

/// Reads all of a part, as whoever goes on from it does. That may throw core::IoError too, which says that it is
/// damaged.
void read_part(const std::filesystem::path& part);

}  // namespace ridgeloc::tests
