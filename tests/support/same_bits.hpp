#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace ridgeloc::tests {

/// Whether two numbers are the same to the last bit: 0 is not -0, and a NaN is one with the same payload only.
inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) { return same_bits(x, y); });
}

/// The same, but any two NaN are alike: two kernels may make them with different signs and payloads.
inline bool same_bits_or_nan(double a, double b) {
  return same_bits(a, b) || (std::isnan(a) && std::isnan(b));
}

}  // namespace ridgeloc::tests
