#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// What of a result a table shows.
struct SummaryChoice {
  std::vector<std::size_t> cells;    ///< ascending
  std::vector<std::size_t> methods;  ///< ascending, differences among them
  std::vector<std::string> metrics;  ///< events too; empty: those that lead
};

/// Everything of a result.
SummaryChoice whole(const Header& header);

/// The methods with these labels, and the differences between two of them. A label may be that of a difference.
/// Precondition: the header has them.
std::vector<std::size_t> methods_labelled(const Header& header, const std::vector<std::string>& labels);

}  // namespace ridgeloc::results
