#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "studies/solving/extent.hpp"

namespace ridgeloc::studies {

/// A range that was measured.
struct Reading {
  std::string object;  ///< what it was measured to; empty where objects have no names
  Place at{};          ///< where that is
  double range_m = 0.0;
  double score = 1.0;
};

/// Ranges that were measured from one position.
struct Epoch {
  std::string label;
  std::size_t line = 0;  ///< of the file, where it begins
  std::vector<Reading> readings;
};

}  // namespace ridgeloc::studies
