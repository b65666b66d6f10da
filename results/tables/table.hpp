#pragma once

#include <string>

#include "results/summary/summary.hpp"
#include "results/tables/summary_choice.hpp"

namespace ridgeloc::results {

/// The text of `ridgeloc summary`: a heading that says what the numbers are, then one table per cell and
/// method with a row per metric and per outcome (failures too when there were none). Every number carries its
/// error; UTF-8, columns aligned over the whole text. Of the choice the cells and methods count; ratios stand with
/// their differences.
std::string summary_table(const Summary& summary, const SummaryChoice& choice);
std::string summary_table(const Summary& summary);

}  // namespace ridgeloc::results
