#pragma once

#include <cstdint>
#include <vector>

namespace ridgeloc::results {

/// The trials of one method in one cell whose values are kept.
struct TrialTable {
  std::vector<std::uint64_t> trial;          ///< number within the cell, ascending
  std::vector<std::uint8_t> status;          ///< per trial; empty: the method reports none
  std::vector<std::vector<double>> metrics;  ///< per `Schema::metrics`; empty: not given by this method
};

}  // namespace ridgeloc::results
