#pragma once

#include <cstddef>
#include <string>

#include "results/summary/summary.hpp"
#include "results/tables/summary_choice.hpp"

namespace ridgeloc::results {

/// Columns that an overview takes at most.
inline constexpr std::size_t summary_width = 100;

/// What a person wants to know of a result, within `summary_width` columns: what it is and whether it is complete, a
/// table with a row per cell and method, the differences of methods that are compared, how often methods failed, and
/// the audit. Every number carries its error. What has no room or is not asked for is named.
std::string summary_overview(const Summary& summary, const SummaryChoice& choice);

}  // namespace ridgeloc::results
