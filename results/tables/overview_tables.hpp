#pragma once
// The tables of an overview.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "results/summary/measure.hpp"
#include "results/tables/fitted_table.hpp"
#include "results/tables/summary_choice.hpp"

namespace ridgeloc::results {

/// A difference is marked where its 95 % interval excludes 0, and twice where it is also beyond what the largest of all
/// `tested` differences of the table exceeds by chance once in 20 such tables (Bonferroni).
struct DifferenceTable {
  FittedTable table;
  std::size_t tested = 0;
  bool any_marked = false;
};

/// A row per cell and method that is no difference, a column per measure.
FittedTable method_table(const Summary& summary, const SummaryChoice& choice, const std::vector<Measure>& measures);

/// A row per cell and difference, a column per measure that is compared.
DifferenceTable difference_table(const Summary& summary, const SummaryChoice& choice,
                                 const std::vector<Measure>& measures);

/// How many of the trials of a method failed, and how.
struct Failures {
  std::uint64_t trials = 0;
  std::uint64_t failed = 0;
  std::vector<std::uint64_t> by_status;
  std::size_t worst_cell = 0;  ///< with the largest share of failures
  double worst_rate = 0.0;
};

/// Those of the chosen cells together.
Failures failures_of(const Summary& summary, const SummaryChoice& choice, std::size_t method);

/// A row per method that runs on trials: how many of those in the chosen cells failed, how, and where most.
FittedTable failure_table(const Summary& summary, const SummaryChoice& choice);

/// Axes on which the chosen cells differ, and the others.
std::vector<std::size_t> varying_axes(const Header& header, const std::vector<std::size_t>& cells);

/// "points = 5, range_sigma_m = 0.3" of some axes.
std::string axes_text(const Header& header, const std::vector<std::size_t>& axes, std::size_t cell);

}  // namespace ridgeloc::results
