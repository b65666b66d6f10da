#pragma once

#include <cstddef>
#include <vector>

namespace ridgeloc::studies {

/// The numbers from, from + step, ... up to `to`, computed in decimals as they are written: 0.1 in steps of 0.1 comes
/// to 0.3, not to 0.30000000000000004, and no digit of `from` is lost.
struct DecimalRange {
  std::vector<double> values;  ///< none where there is no such range, or one of more than `most` numbers
  bool reaches_end = false;    ///< whether `to` is the last of them
  double beyond = 0.0;         ///< the number after the last
};

/// Precondition: all three are finite.
DecimalRange decimal_range(double from, double to, double step, std::size_t most);

}  // namespace ridgeloc::studies
