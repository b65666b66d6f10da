#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/real.hpp"

/// Elementary functions over `Real`. The C library's own differ between versions and processors in the last bit, and
/// results must not; these use only correctly rounded operations in a fixed order.
namespace ridgeloc::core {

/// Largest errors of these functions over their ranges, in units in the last place of the result. The tests hold the
/// functions to the same constants.
inline constexpr double log_max_error_ulp = 3.0;
inline constexpr double exp_max_error_ulp = 2.0;
inline constexpr double exp_minus_one_max_error_ulp = 3.0;
inline constexpr double inverse_cube_root_max_error_ulp = 2.0;
/// Of sine and cosine: absolute, as a multiple of 2^-53.
inline constexpr double sin_cos_max_error = 2.5;

/// c[0] t^(N-1) + ... + c[N-1] by Horner's rule.
template <class Real, std::size_t N>
Real polynomial(const std::array<double, N>& c, Real t) {
  Real sum(c[0]);
  for (std::size_t i = 1; i < N; ++i) sum = mul_add(sum, t, Real(c[i]));
  return sum;
}

/// Natural logarithm of a positive normal number.
///
/// log x = e log 2 + log m, m in [sqrt(1/2), sqrt 2), log m = 2 atanh s = 2 s + s^3 P(s^2), s = (m - 1)/(m + 1),
/// |s| < 0.1716. P is the Chebyshev fit of degree 6; it adds 5e-18 to the relative error.
template <class Real>
Real log(Real x) {
  constexpr double sqrt_two = 1.4142135623730951;
  constexpr double log_two_high = 0.693147180369123816490;  // upper 33 bits: exponent times this is exact
  constexpr double log_two_low = 1.90821492927058770002e-10;
  constexpr std::array<double, 7> fit = {0.14616449820782476, 0.15331721589574307, 0.181828891255921,
                                         0.22222211134790545, 0.28571428625975515, 0.39999999999899505,
                                         0.666666666666667};
  const Split<Real> parts = split(x);
  const Mask<Real> upper = parts.mantissa > Real(sqrt_two);
  const Real m = select(upper, parts.mantissa * Real(0.5), parts.mantissa);
  const Real e = select(upper, parts.exponent + Real(1.0), parts.exponent);
  const Real s = (m - Real(1.0)) * reciprocal(m + Real(1.0));
  const Real s2 = s * s;
  const Real tail = s * s2 * polynomial(fit, s2);
  return mul_add(e, Real(log_two_high), mul_add(Real(2.0), s, mul_add(e, Real(log_two_low), tail)));
}

/// e^x = 2^exponent (1 + rest).
template <class Real>
struct ExpParts {
  Real exponent;
  Real rest;
};

/// For |x| <= 708: exponent = round(x / log 2) and rest = e^r - 1 = r + r^2 / 2 + r^3 P(r), where r = x - exponent log
/// 2, |r| <= log(2) / 2. P is the Chebyshev fit of degree 9; it adds 2e-18 to the relative error.
template <class Real>
ExpParts<Real> exp_parts(Real x) {
  constexpr double inverse_log_two = 1.4426950408889634;
  constexpr double log_two_high = 0.693147180369123816490;  // upper 33 bits: exponent times this is exact
  constexpr double log_two_low = 1.90821492927058770002e-10;
  constexpr std::array<double, 10> fit = {2.0911229729827565e-09, 2.510037583265786e-08,  2.755728298405573e-07,
                                          2.755726848030982e-06,  2.4801587317135164e-05, 0.00019841269863040545,
                                          0.0013888888888886554,  0.008333333333330065,   0.041666666666666664,
                                          0.16666666666666669};
  const Real exponent = round_to_integer(x * Real(inverse_log_two));
  const Real r = neg_mul_add(exponent, Real(log_two_low), neg_mul_add(exponent, Real(log_two_high), x));
  return {exponent, mul_add(r * r, mul_add(r, polynomial(fit, r), Real(0.5)), r)};
}

/// e^x for |x| <= 708.
template <class Real>
Real exp(Real x) {
  const ExpParts<Real> parts = exp_parts(x);
  const Real power = power_of_two(parts.exponent);
  return mul_add(power, parts.rest, power);
}

/// e^x - 1 for |x| <= 708; near zero it keeps the digits that exp(x) - 1 loses.
template <class Real>
Real exp_minus_one(Real x) {
  const ExpParts<Real> parts = exp_parts(x);
  const Real power = power_of_two(parts.exponent);
  return mul_add(power, parts.rest, power - Real(1.0));
}

template <class Real>
struct SinCos {
  Real sin;
  Real cos;
};

/// Sine and cosine of an angle in turns (1 turn = 2 pi), |turns| < 2^40.
///
/// The quadrant is split off exactly, since a quarter turn is a binary fraction; what remains is x, |x| <= pi/4, with
/// sin x = x + x^3 S(x^2) and cos x = 1 - x^2/2 + x^4 C(x^2). S and C are Chebyshev fits of degree 5; they add less
/// than 2e-17.
template <class Real>
SinCos<Real> sin_cos_turns(Real turns) {
  constexpr double two_pi = 6.283185307179586;
  constexpr double two_pi_low = 2.4492935982947064e-16;
  constexpr std::array<double, 6> sin_fit = {1.5918129280835e-10,     -2.5051131844808866e-08, 2.7557316102551507e-06,
                                             -0.00019841269836758574, 0.008333333333330948,    -0.16666666666666666};
  constexpr std::array<double, 6> cos_fit = {-1.1382632416743667e-11, 2.087614626828136e-09,  -2.755731727172921e-07,
                                             2.4801587298765686e-05,  -0.0013888888888887398, 0.041666666666666664};
  const Real quarter = round_to_integer(turns * Real(4.0));
  const Real rest = neg_mul_add(quarter, Real(0.25), turns);
  const Real x = mul_add(rest, Real(two_pi), rest * Real(two_pi_low));
  const Real x2 = x * x;
  const Real s = mul_add(x * x2, polynomial(sin_fit, x2), x);
  const Real c = mul_add(x2 * x2, polynomial(cos_fit, x2), neg_mul_add(Real(0.5), x2, Real(1.0)));

  // The two lowest bits of the quadrant: sine and cosine change places in odd ones; the sine turns negative in 2 and 3,
  // the cosine in 1 and 2. Adding 2^52 + 2^51 puts these bits at the end of the fraction, for negative quadrants too.
  const Words<Real> quadrant = bits_of(quarter + Real(6755399441055744.0));
  const Words<Real> one(1U);
  const Mask<Real> odd = from_bits((quadrant << 63) | bits_of(Real(1.0))) < Real(0.0);
  const Words<Real> sin_sign = (quadrant >> 1) << 63;
  const Words<Real> cos_sign = ((quadrant + one) >> 1) << 63;
  return {from_bits(bits_of(select(odd, c, s)) ^ sin_sign), from_bits(bits_of(select(odd, s, c)) ^ cos_sign)};
}

/// x^(-1/3) of a positive normal number.
///
/// The first guess takes a third of the exponent, by way of the upper half of the bits, and is within 3.5 %. With
/// r = 1 - x y^3, each of two steps y <- y (1 + r/3 + 2 r^2/9 + 14 r^3/81), the first terms of (1 - r)^(-1/3), raises
/// the relative error to its fourth power: 2e-5, then rounding.
template <class Real>
Real inverse_cube_root(Real x) {
  constexpr std::uint64_t upper_half = 0xffffffff00000000U;
  constexpr std::uint64_t third = 0x55555556U;  // of 2^32
  constexpr std::uint64_t guess_of_zero =
      0x553ef0ff00000000U;  // 4/3 of the exponent bias, tuned for the fraction's error
  const Words<Real> third_of_bits = multiply_low_words(bits_of(x) >> 32, Words<Real>(third)) & Words<Real>(upper_half);
  Real y = from_bits(Words<Real>(guess_of_zero) - third_of_bits);
  for (int step = 0; step < 2; ++step) {
    const Real r = neg_mul_add(x * y, y * y, Real(1.0));
    const Real series = mul_add(r, mul_add(r, Real(14.0 / 81.0), Real(2.0 / 9.0)), Real(1.0 / 3.0));
    y = mul_add(y * r, series, y);
  }
  return y;
}

}  // namespace ridgeloc::core
