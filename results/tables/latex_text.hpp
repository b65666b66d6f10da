#pragma once

#include <string>
#include <string_view>

#include "results/summary/measure.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// Text that LaTeX shows as it is, also at the beginning of a row.
std::string latex_text(std::string_view text);

/// What leads of a row, in mathematics, with the standard error of its last digits; one that is not reliable is marked.
std::string latex_number(const SummaryRow& row, Measure::Lead lead);

/// The head of a column of short entries, on several lines where it is long.
std::string latex_head(const std::string& text);

/// A name that \ref can name.
std::string latex_label(const std::string& name);

}  // namespace ridgeloc::results
