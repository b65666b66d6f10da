#pragma once

#include "core/real.hpp"

/// Elementary functions over `Real`. The C library's own differ between versions and processors in the last bit, and
/// results must not; these use only correctly rounded operations in a fixed order.
namespace ridgeloc::core {

/// Largest errors of these functions over their ranges, in units in the last place of the result. The tests hold the
/// functions to the same constants.
inline constexpr double log_max_error_ulp = 2.0;
inline constexpr double cube_root_max_error_ulp = 2.0;
/// Of sine and cosine: absolute, as a multiple of 2^-53.
inline constexpr double sin_cos_max_error = 2.5;

/// Natural logarithm of a positive normal number.
///
/// log x = e log 2 + log m, m in [sqrt(1/2), sqrt 2), log m = 2 atanh s with s = (m - 1)/(m + 1), |s| < 0.1716; the
/// series stops at s^23, the first neglected term is below 2^-64 of the result.
template <class Real>
Real log(Real x) {
  constexpr double sqrt_two = 1.4142135623730951;
  constexpr double log_two_high = 0.693147180369123816490;  // upper 33 bits: exponent times this is exact
  constexpr double log_two_low = 1.90821492927058770002e-10;
  auto parts = split(x);
  const Mask<Real> upper = parts.mantissa > Real(sqrt_two);
  const Real m = select(upper, parts.mantissa * Real(0.5), parts.mantissa);
  const Real e = select(upper, parts.exponent + Real(1.0), parts.exponent);
  const Real s = (m - Real(1.0)) / (m + Real(1.0));
  const Real s2 = s * s;
  Real series = Real(1.0 / 23.0);
  for (int k = 21; k >= 3; k -= 2) series = series * s2 + Real(1.0 / k);
  const Real tail = Real(2.0) * s * s2 * series;
  return e * Real(log_two_high) + (Real(2.0) * s + (tail + e * Real(log_two_low)));
}

template <class Real>
struct SinCos {
  Real sin;
  Real cos;
};

/// Sine and cosine of an angle in turns (1 turn = 2 pi), |turns| < 2^40.
///
/// The quadrant is split off exactly, since a quarter turn is a binary fraction; what remains is at most pi/4, where
/// the Taylor series to x^17 and x^16 are exact to less than 2^-60.
template <class Real>
SinCos<Real> sin_cos_turns(Real turns) {
  constexpr double two_pi = 6.283185307179586;
  constexpr double two_pi_low = 2.4492935982947064e-16;
  const Real quarter = round_to_integer(turns * Real(4.0));
  const Real rest = turns - quarter * Real(0.25);
  const Real x = rest * Real(two_pi) + rest * Real(two_pi_low);
  const Real x2 = x * x;

  constexpr double factorial[] = {1.0,
                                  1.0,
                                  2.0,
                                  6.0,
                                  24.0,
                                  120.0,
                                  720.0,
                                  5040.0,
                                  40320.0,
                                  362880.0,
                                  3628800.0,
                                  39916800.0,
                                  479001600.0,
                                  6227020800.0,
                                  87178291200.0,
                                  1307674368000.0,
                                  20922789888000.0,
                                  355687428096000.0};
  Real sin_series = Real(1.0 / factorial[17]);
  Real cos_series = Real(1.0 / factorial[16]);
  for (int k = 15; k >= 3; k -= 2) {
    const double sign = (k / 2) % 2 == 0 ? 1.0 : -1.0;
    sin_series = sin_series * x2 + Real(sign / factorial[k]);
    cos_series = cos_series * x2 + Real(sign / factorial[k - 1]);
  }
  const Real s = x + x * x2 * sin_series;
  const Real c = Real(1.0) + x2 * cos_series;

  // quadrant 0: (s, c), 1: (c, -s), 2: (-s, -c), 3: (-c, s)
  const Real half = round_to_integer(quarter * Real(0.5) - Real(0.25));  // floor(quarter / 2)
  const Mask<Real> odd = quarter - half * Real(2.0) > Real(0.5);
  const Mask<Real> flipped = half - Real(2.0) * round_to_integer(half * Real(0.5) - Real(0.25)) > Real(0.5);
  const Real sin_value = select(odd, c, s);
  const Real cos_value = select(odd, -s, c);
  return {select(flipped, -sin_value, sin_value), select(flipped, -cos_value, cos_value)};
}

/// Cube root of a positive normal number: three Halley steps, each of which cubes the relative error of the first guess
/// (4 %, 4e-5, 5e-14, rounding).
template <class Real>
Real cube_root(Real x) {
  Real y = cube_root_guess(x);
  for (int step = 0; step < 3; ++step) {
    const Real cube = y * y * y;
    y = y + y * ((x - cube) / (cube + cube + x));
  }
  return y;
}

}  // namespace ridgeloc::core
