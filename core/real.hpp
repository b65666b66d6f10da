#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

/// The vocabulary in which kernels are written: a `Real` is either `double` (one trial) or a SIMD pack of them (one
/// trial per lane), a `Mask` answers a question for every lane, and `Words` holds 64 bits per lane. Kernels never
/// branch on a value that differs between lanes: they select. This header defines the vocabulary for `double`,
/// core/pack.hpp for packs; comparisons, arithmetic and bit operations are the operators.
namespace ridgeloc::core {

/// What belongs to a number type. `Narrow` is the same in one register per value: half the code, for kernels that need
/// not be the fastest.
template <class Real>
struct RealTraits;

template <>
struct RealTraits<double> {
  using Mask = bool;
  using Words = std::uint64_t;
  using Narrow = double;
  static constexpr std::size_t lanes = 1;
  static double load(const double* from) { return *from; }
};

template <class Real>
using Mask = typename RealTraits<Real>::Mask;
template <class Real>
using Words = typename RealTraits<Real>::Words;
template <class Real>
inline constexpr std::size_t lanes = RealTraits<Real>::lanes;

/// a where the mask holds, b elsewhere.
inline double select(bool mask, double a, double b) {
  return mask ? a : b;
}
inline bool any(bool mask) {
  return mask;
}
/// Bit i tells whether the mask holds in lane i.
inline std::uint32_t lane_bits(bool mask) {
  return mask ? 1U : 0U;
}

/// a b + c: rounded once where the instruction set multiplies and adds in one instruction, twice elsewhere.
inline double mul_add(double a, double b, double c) {
  return a * b + c;
}
/// c - a b, likewise.
inline double neg_mul_add(double a, double b, double c) {
  return c - a * b;
}

/// Correctly rounded square root; in packs for 2^-960 < x < 2^1000, for 0, infinity, negative numbers and NaN.
inline double sqrt(double x) {
  return std::sqrt(x);
}
/// Correctly rounded 1 / x; in packs for 2^-1000 < |x| < 2^1000, for 0, infinity and NaN.
inline double reciprocal(double x) {
  return 1.0 / x;
}

template <class Real>
struct RootAndInverse {
  Real root;
  Real inverse;
};
/// sqrt(x) and the reciprocal of that, each rounded as above.
inline RootAndInverse<double> root_and_inverse(double x) {
  const double root = std::sqrt(x);
  return {root, 1.0 / root};
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

/// The bits of a number, and the number of these bits.
inline std::uint64_t bits_of(double x) {
  return std::bit_cast<std::uint64_t>(x);
}
inline double from_bits(std::uint64_t bits) {
  return std::bit_cast<double>(bits);
}
/// Product of the lower halves.
inline std::uint64_t multiply_low_words(std::uint64_t a, std::uint64_t b) {
  return (a & 0xffffffffU) * (b & 0xffffffffU);
}

/// Nearest integer, ties to even, for |x| < 2^51.
template <class Real>
Real round_to_integer(Real x) {
  constexpr double shift = 6755399441055744.0;  // 1.5 * 2^52: the sum has no room for a fraction
  return (x + Real(shift)) - Real(shift);
}

/// A whole number in [0, 2^51) as an integer.
template <class Real>
Words<Real> to_words(Real whole) {
  constexpr std::uint64_t mantissa = 0x000fffffffffffffU;
  return bits_of(whole + Real(0x1p52)) & Words<Real>(mantissa);
}

/// 2^exponent for a whole exponent from -1022 to 1023.
template <class Real>
Real power_of_two(Real exponent) {
  constexpr double shift = 6755399441055744.0;  // 1.5 * 2^52: the whole number ends up in the lowest bits
  return from_bits(bits_of(exponent + Real(shift + 1023.0)) << 52);
}

/// x = mantissa * 2^exponent with mantissa in [1, 2), for positive normal x.
template <class Real>
struct Split {
  Real mantissa;
  Real exponent;
};
template <class Real>
Split<Real> split(Real x) {
  constexpr std::uint64_t mantissa = 0x000fffffffffffffU;
  constexpr std::uint64_t exponent_of_one = 0x3ff0000000000000U;
  constexpr std::uint64_t exponent_of_two_to_52 = 0x4330000000000000U;
  const Words<Real> bits = bits_of(x);
  return {from_bits((bits & Words<Real>(mantissa)) | Words<Real>(exponent_of_one)),
          from_bits((bits >> 52) | Words<Real>(exponent_of_two_to_52)) - Real(0x1p52 + 1023.0)};
}

/// The values at from[0], from[1], ..., one per lane, and back.
template <class Real>
Real load(const double* from) {
  return RealTraits<Real>::load(from);
}
inline void store(double* to, double value) {
  *to = value;
}

/// The values of the trials from `first` on, one per lane; lanes beyond the end of the column get zeros.
template <class Real>
Real load_column(std::span<const double> column, std::size_t first) {
  if (first + lanes<Real> <= column.size()) return load<Real>(column.data() + first);
  double values[lanes<Real>] = {};
  for (std::size_t lane = 0; first + lane < column.size(); ++lane) values[lane] = column[first + lane];
  return load<Real>(values);
}

/// Writes them back; lanes beyond the end of the column are dropped. Whole numbers may go to a column of small
/// integers.
template <class Real>
void store_column(std::span<double> column, std::size_t first, const Real& value) {
  if (first + lanes<Real> <= column.size()) return store(column.data() + first, value);
  double values[lanes<Real>];
  store(values, value);
  for (std::size_t lane = 0; first + lane < column.size(); ++lane) column[first + lane] = values[lane];
}
template <class Real>
void store_column(std::span<std::uint8_t> column, std::size_t first, const Real& value) {
  double values[lanes<Real>];
  store(values, value);
  const std::size_t end = std::min(lanes<Real>, column.size() - first);
  for (std::size_t lane = 0; lane < end; ++lane) column[first + lane] = static_cast<std::uint8_t>(values[lane]);
}

/// table[floor(position)] for positions from 0 to below 2^52, in every lane.
template <class Real>
Real look_up(const double* table, const Real& position) {
  double values[lanes<Real>];
  store(values, position);
  for (double& value : values) value = table[static_cast<std::size_t>(value)];
  return load<Real>(values);
}

/// first, first + 1, ..., one number per lane.
template <class Real>
Real lane_numbers(std::size_t first) {
  double values[lanes<Real>];
  for (std::size_t lane = 0; lane < lanes<Real>; ++lane) values[lane] = static_cast<double>(first + lane);
  return load<Real>(values);
}
template <class Real>
Words<Real> trial_words(std::uint64_t first) {
  return Words<Real>(first) + to_words(lane_numbers<Real>(0));
}

}  // namespace ridgeloc::core
