#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "results/statistics/extremes.hpp"

namespace ridgeloc::results {

/// Histogram of non-negative values on a fixed logarithmic grid: octaves 2^-40 .. 2^20, each cut into 32 equal bins,
/// one bin for everything below (zero included) and one for everything above (infinite included). NaN is not counted.
///
/// Counts are integers, so histograms merge exactly in any order. Only the range of bins in use is kept.
class Histogram {
 public:
  static constexpr int bins_per_octave = 32;
  static constexpr int lowest_octave = -40;
  static constexpr int highest_octave = 20;
  static constexpr std::uint32_t bins = (highest_octave - lowest_octave) * bins_per_octave + 2;

  Histogram() = default;
  /// As read from a file: counts of the bins first_bin, first_bin + 1, ...
  Histogram(std::uint32_t first_bin, std::vector<std::uint64_t> counts);

  void add(std::span<const double> values) { add(values, extremes_of(values)); }
  /// The same. Precondition: the extremes are those of the values.
  void add(std::span<const double> values, const Extremes& extremes, InstructionSet set = best_instruction_set());
  void merge(const Histogram& other);

  static std::uint32_t bin_of(double value);
  /// Lower edge of a bin (0 for bin 0; the upper edge of bin b is lower_edge(b + 1), infinite for the last one).
  static double lower_edge(std::uint32_t bin);

  std::uint32_t first_bin() const { return first_bin_; }
  const std::vector<std::uint64_t>& counts() const { return counts_; }
  std::uint64_t total() const;

  /// Value below which a share q in [0, 1] of the sample lies, linear within the bin; NaN when empty, infinite when it
  /// falls into the last bin. Resolution: one bin, at most 1/32 of the value.
  double quantile(double q) const;

  friend bool operator==(const Histogram&, const Histogram&) = default;

 private:
  std::uint32_t first_bin_ = 0;
  std::vector<std::uint64_t> counts_;
};

}  // namespace ridgeloc::results
