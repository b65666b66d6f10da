#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// The folder in which a run collects the parts of a result: r.h5.parts for r.h5.
std::filesystem::path parts_folder(const std::filesystem::path& result);

/// The name of a part in it, "part-000012.h5", and the number in such a name; 0 for another one.
std::string part_name(std::uint64_t number);
std::uint64_t part_number(const std::filesystem::path& part);

/// Files in such a folder that are called like parts, in order of their numbers, and temporaries that a killed program
/// has left. What else lies there is not the program's. Empty if there is no folder.
struct PartsFolderContent {
  std::vector<std::filesystem::path> parts;
  std::vector<std::filesystem::path> temporaries;
};
PartsFolderContent content_of(const std::filesystem::path& folder);

/// Bytes of all that is there of a result: the sealed file and the parts beside it.
std::uintmax_t stored_bytes(const std::filesystem::path& path);

/// What the files of a result say of themselves: the sealed one at `path`, if there is one, then the parts that a
/// stopped run has left beside it. Of files with the same study it is the first, and damaged parts are passed over: the
/// writer reports them. Throws core::InputError if the sealed one is damaged, and if anything is of a version of the
/// format that this program does not know.
std::vector<Header> headers_at(const std::filesystem::path& path);

}  // namespace ridgeloc::results
