#pragma once

#include <cstdint>
#include <span>

#include "results/statistics/instruction_set.hpp"

namespace ridgeloc::results {

/// Count, mean and central sums M_k = sum (v - mean)^k of a sample: everything that the standard errors of a mean, a
/// standard deviation and a mean square need.
struct Moments {
  std::uint64_t n = 0;
  double mean = 0.0;
  double m2 = 0.0;
  double m3 = 0.0;
  double m4 = 0.0;

  friend bool operator==(const Moments&, const Moments&) = default;
};

/// Values above this size (and infinite ones) are counted beside the moments instead of entering them.
inline constexpr double largest_moment_value = 1e6;

/// Moments of the values that are finite and at most `largest_moment_value` in size, in two passes with a fixed number
/// of accumulators, so that the result is the same bits on every instruction set of equal precision.
Moments moments_of(std::span<const double> values, InstructionSet set = best_instruction_set());

/// Moments of the union of two disjoint samples (Chan et al. 1979; Pebay 2008). Merge order changes the last bits:
/// callers merge over the fixed binary tree of block numbers.
Moments merge(const Moments& a, const Moments& b);

}  // namespace ridgeloc::results
