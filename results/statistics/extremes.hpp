#pragma once

#include <limits>
#include <span>

#include "results/statistics/instruction_set.hpp"

namespace ridgeloc::results {

/// Smallest and largest value of a sample; of an empty one, the neutral elements.
struct Extremes {
  double min = std::numeric_limits<double>::infinity();
  double max = -std::numeric_limits<double>::infinity();
};

/// NaN is passed over.
Extremes extremes_of(std::span<const double> values, InstructionSet set = best_instruction_set());

}  // namespace ridgeloc::results
