#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "results/blocks/trial_table.hpp"
#include "results/summary/ratio.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// One value of an axis, with which all others are compared.
struct AxisValue {
  std::size_t axis = 0;
  std::size_t value = 0;  ///< index into `Axis::values`
};

/// "range_sigma_m=0.1". Throws core::InputError, with what is allowed, if the text names no value of an axis.
AxisValue axis_value(const Header& header, std::string_view text);

/// The mean of one metric of one method in a cell against that in another cell.
struct CellComparison {
  std::size_t cell = 0;
  std::size_t against = 0;
  std::size_t method = 0;
  std::size_t metric = 0;  ///< index into the schema
  std::uint64_t n = 0;     ///< values behind each mean
  std::uint64_t n_against = 0;
  Estimate difference;       ///< of the means, first minus second
  Estimate ratio;            ///< of the means
  double correlation = 0.0;  ///< of the two cells' values in the same trial; NaN where it is not known
  std::uint64_t paired = 0;  ///< trials that it is known from; without any the means count as independent
  bool trusted = false;
};

/// The kept trials of a method in a cell.
using TrialReader = std::function<TrialTable(std::size_t cell, std::size_t method)>;

/// Compares every cell with the one that differs from it in the axis alone and has the value there, for all methods and
/// the metrics that they report, but for those that are yes or no.
///
/// Trial t of one cell is compared with trial t of the other. Where both begin with the same random numbers (another
/// noise level, say) their values go together, where they do not (another field of view) the correlation comes out as
/// about zero: the error is right in either case. The means are over all N trials of each cell; their covariance is
///
///   r s(a) s(b) sqrt(min(N_a, N_b) / max(N_a, N_b)),   r = sum i_a i_b / sqrt(sum i_a^2 sum i_b^2)
///
/// over the trials that both cells keep, i the value less its mean, and 0 where the trial is not in the population.
/// Where the cells keep fewer than ten common trials, or one is incomplete, so that they need not have the same trials,
/// the means count as independent: the error is then too long if the values go together.
///
/// Throws core::InputError if no two cells differ in the axis alone.
std::vector<CellComparison> compare_cells(const Summary& summary, const AxisValue& base, const TrialReader& trials);

}  // namespace ridgeloc::results
