#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

/// The vocabulary in which kernels are written: a `Real` is either `double` (one trial) or a SIMD pack of them (one
/// trial per lane), and a `Mask` answers a question for every lane. Kernels never branch on a value that differs
/// between lanes: they select. This header defines the vocabulary for `double`; comparisons and arithmetic are the
/// built-in operators.
namespace ridgeloc::core {

/// What belongs to a number type: the type of a comparison, and the type that numbers the trials in its lanes.
template <class Real>
struct RealTraits;

template <>
struct RealTraits<double> {
  using Mask = bool;
  using Index = std::size_t;
};

template <class Real>
using Mask = typename RealTraits<Real>::Mask;
template <class Real>
using Index = typename RealTraits<Real>::Index;

/// a where the mask holds, b elsewhere.
inline double select(bool mask, double a, double b) {
  return mask ? a : b;
}
inline bool any(bool mask) {
  return mask;
}

inline double sqrt(double x) {
  return std::sqrt(x);
}
inline double abs(double x) {
  return std::fabs(x);
}
inline double max(double a, double b) {
  return a < b ? b : a;
}
inline bool is_finite(double x) {
  return std::fabs(x) <= std::numeric_limits<double>::max();
}

/// Nearest integer, ties to even, for |x| < 2^51.
inline double round_to_integer(double x) {
  constexpr double shift = 6755399441055744.0;  // 1.5 * 2^52: the sum has no room for a fraction
  return (x + shift) - shift;
}

/// x = mantissa * 2^exponent with mantissa in [1, 2), for positive normal x.
struct SplitDouble {
  double mantissa;
  double exponent;
};
inline SplitDouble split(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto mantissa = (bits & 0x000fffffffffffffU) | 0x3ff0000000000000U;
  return {std::bit_cast<double>(mantissa), static_cast<double>(static_cast<std::int64_t>(bits >> 52) - 1023)};
}

/// A first guess of the cube root of a positive normal number, within 4 %: a third of the exponent, by way of the bits.
inline double cube_root_guess(double x) {
  constexpr std::uint64_t bias = 0x2a9f7893782da1ceU;  // 2/3 of the exponent bias, tuned for the mantissa's error
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) / 3 + bias);
}

/// Values of the trials in the lanes, and back.
inline double load(std::span<const double> column, std::size_t trial) {
  return column[trial];
}
inline void store(std::span<double> column, std::size_t trial, double value) {
  column[trial] = value;
}
/// Stores small integers, held as reals while they are selected.
inline void store_status(std::span<std::uint8_t> column, std::size_t trial, double code) {
  column[trial] = static_cast<std::uint8_t>(code);
}

}  // namespace ridgeloc::core
