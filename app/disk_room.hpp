#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/continuation.hpp"
#include "results/store/result_writer.hpp"

namespace ridgeloc::app {

/// Bytes of a block in the ledger of a result, for each method: its digest, which does not compress.
inline constexpr double bytes_per_block = sizeof(std::uint64_t);

/// "512 KiB", "1.5 MiB", "24 GiB".
std::string size_text(double bytes);

/// Bytes that are free on the disk of a folder for this user; infinite where that cannot be told.
double free_bytes(const std::filesystem::path& folder);

/// Refuses with core::InputError, before anything is computed, to run what has no room beside the name of its result,
/// and warns where its parts have and the result, which is written while they are there, has not. Counts what the
/// writer lacks of the assignment; a cell with a stop rule lacks all trials up to the most until it has reached its
/// target. Tries one trial where the plan alone cannot tell. The writer is the one that `studies::writer_of` makes.
void require_room(const Job& job, const results::ResultWriter& writer);

}  // namespace ridgeloc::app
