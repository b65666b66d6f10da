#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/continuation.hpp"
#include "results/store/result_writer.hpp"
#include "results/store/writing_cost.hpp"

namespace ridgeloc::app {

/// Bytes of a block in the ledger of a result, for each method: its digest, which does not compress.
inline constexpr double bytes_per_block = sizeof(std::uint64_t);

/// "512 KiB", "1.5 MiB", "24 GiB".
std::string size_text(double bytes);

/// Why no values of single trials are kept where the study asks for some.
std::string too_small_text(const studies::Study& study, const studies::Plan& plan);

/// Bytes that are free on the disk of a folder for this user; infinite where that cannot be told.
double free_bytes(const std::filesystem::path& folder);

/// What it costs to write the result of a study.
struct WritingForecast {
  results::WritingCost cost;
  std::string not_tried;  ///< why it could not be tried; the sizes are then rough, and no time is known
};

/// Tries it with rows and columns of a pilot; `cell_trials`: that each cell will have.
WritingForecast writing_forecast(const studies::Study& study, const studies::Plan& plan,
                                 const std::vector<results::Row>& rows, std::vector<results::TrialColumns> columns,
                                 const std::vector<std::uint64_t>& cell_trials);

/// Refuses with core::InputError, before anything is computed, to run what has no room beside the name of its result,
/// and warns where its parts have and the result, which is written while they are there, has not. Counts what the
/// writer lacks of the assignment; a cell with a stop rule lacks all trials up to the most until it has reached its
/// target. Forecasts as `plan` does, from a few trials, where the study alone cannot tell. The writer is the one that
/// `studies::writer_of` makes.
void require_room(const Job& job, const results::ResultWriter& writer);

}  // namespace ridgeloc::app
