#pragma once

#include <filesystem>

namespace ridgeloc::tests {

/// Calls every public reader of results and what verbs make of their answers. They may throw core::InputError and
/// nothing else.
void read_everything(const std::filesystem::path& result);

/// Goes on from the parts beside a result as `ridgeloc run` does, and seals them if they are complete enough. That may
/// throw core::IoError too.
void continue_from_parts(const std::filesystem::path& result);

}  // namespace ridgeloc::tests
