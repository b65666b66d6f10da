#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "results/statistics/extremes.hpp"

namespace ridgeloc::results {

/// Histogram of non-negative values on a fixed logarithmic grid that has a bin for every number: each octave is cut
/// into 32 equal bins, and the number of a bin is the upper 17 bits of the IEEE doubles in it. Bin 0 has zero and all
/// below 2^-1027, negative values included; the last one has infinity alone. NaN is not counted.
///
/// Counts are integers, so histograms merge exactly in any order. Only bins with values are kept.
class Histogram {
 public:
  static constexpr std::uint32_t bins_per_octave = 32;
  static constexpr std::uint32_t infinite_bin = 0x7ff * bins_per_octave;

  struct Bin {
    std::uint32_t number = 0;
    std::uint64_t count = 0;

    friend bool operator==(const Bin&, const Bin&) = default;
  };

  /// Where the values of a sample lie, from the smallest to the largest.
  struct Range {
    double min = 0.0;
    double max = std::numeric_limits<double>::infinity();
  };

  Histogram() = default;
  /// As read from a file. Throws std::invalid_argument unless numbers ascend up to `infinite_bin` and no bin is empty.
  explicit Histogram(std::vector<Bin> bins);

  void add(std::span<const double> values) { add(values, extremes_of(values)); }
  /// The same. Precondition: the extremes are those of the values.
  void add(std::span<const double> values, const Extremes& extremes, InstructionSet set = best_instruction_set());
  void merge(const Histogram& other);

  static std::uint32_t bin_of(double value);
  /// Lower edge of a bin, which belongs to it. The upper edge of bin b is lower_edge(b + 1).
  static double lower_edge(std::uint32_t bin);

  /// Those with values, ascending.
  const std::vector<Bin>& bins() const { return bins_; }
  std::uint64_t count_in(std::uint32_t bin) const;
  std::uint64_t total() const;

  /// Value below which a share q in [0, 1] of the sample lies, linear within the bin; NaN when empty, infinite when it
  /// falls among infinite values. Resolution: one bin, at most 1/32 of the value. The bins at the ends of the sample
  /// reach to its smallest and largest value alone, where these are given.
  double quantile(double q) const { return quantile(q, Range()); }
  double quantile(double q, const Range& range) const;

  friend bool operator==(const Histogram&, const Histogram&) = default;

 private:
  std::vector<Bin> bins_;
};

}  // namespace ridgeloc::results
