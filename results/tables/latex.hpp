#pragma once

#include <string>
#include <vector>

#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// What the tables of a result show where nothing is asked for: the metrics and events of the study's figures, else its
/// first metric and first event.
std::vector<std::string> leading_quantities(const Header& header);

/// Where a table comes from.
struct LatexSource {
  std::string digest;   ///< of the data; its first 12 digits enter the captions. Empty: the result is not sealed yet
  std::string command;  ///< that makes the tables, for a comment
};

/// A LaTeX table (packages booktabs, and longtable where it is longer than a page) for each of the metrics and events.
/// The values of the longest axis of at most 8 stand across the columns, else the methods; all else in rows. Values are
/// the median of heavy-tailed metrics, else the mean or the rate, followed by the standard error of their last digits
/// in parentheses: 0.1352(12). Those of medians and rates are the width of the 95 % interval over 3.92. The best method
/// of a cell is bold where it is significantly so (`ranking_of`). Differences of methods are left out.
///
/// Throws core::InputError for a name that the schema has not, and for one that no method reports.
std::string latex_tables(const Summary& summary, const std::vector<std::string>& quantities, const LatexSource& source);

}  // namespace ridgeloc::results
