#pragma once

#include <limits>

#include "core/elementary.hpp"
#include "core/matrix.hpp"
#include "solvers/estimators/k_context.hpp"
#include "solvers/estimators/true_k.hpp"

/// The functions of formulas of K, defined for every number: those of core/elementary.hpp are for what kernels give
/// them, and what a user's formula gives nobody knows. Only `formula_log`, `formula_exp`, `formula_geometric_mean` and
/// what is made of them multiply and add in one, so that all others are the same bits on every instruction set.
namespace ridgeloc::solvers {

inline constexpr double formula_smallest = std::numeric_limits<double>::min();
inline constexpr double formula_infinity = std::numeric_limits<double>::infinity();
inline constexpr double formula_nan = std::numeric_limits<double>::quiet_NaN();

/// Correctly rounded for all x: core::sqrt of packs is for 2^-960 < x < 2^1000.
template <class Real>
[[gnu::always_inline]] inline Real formula_sqrt(const Real& x) {
  const core::Mask<Real> small = x < Real(0x1p-900);
  const core::Mask<Real> large = x > Real(0x1p900);
  const Real scaled = x * core::select(small, Real(0x1p200), core::select(large, Real(0x1p-200), Real(1.0)));
  return core::sqrt(scaled) * core::select(small, Real(0x1p-100), core::select(large, Real(0x1p100), Real(1.0)));
}

/// Natural logarithm: -infinity of 0 and of what is below the normal numbers, NaN of negative numbers.
template <class Real>
[[gnu::noinline]] Real formula_log(const Real& x) {
  const core::Mask<Real> normal = (Real(formula_smallest) <= x) & core::is_finite(x);
  const Real special =
      core::select(x < Real(0.0), Real(formula_nan),
                   core::select(x < Real(formula_smallest), Real(-formula_infinity), x));  // infinity and NaN stay
  return core::select(normal, core::log(core::select(normal, x, Real(1.0))), special);
}

/// e^x: 0 below -708, infinity above 708.
template <class Real>
[[gnu::noinline]] Real formula_exp(const Real& x) {
  constexpr double limit = 708.0;
  const core::Mask<Real> above = x > Real(limit);
  const core::Mask<Real> below = x < Real(-limit);
  const Real inside = core::select(above | below, Real(0.0), x);  // NaN stays
  return core::select(above, Real(formula_infinity), core::select(below, Real(0.0), core::exp(inside)));
}

/// x^y for x >= 0, otherwise NaN, but 1 for y = 0: its relative error is about that of y log x.
template <class Real>
Real formula_power(const Real& x, const Real& y) {
  const core::Mask<Real> is_zero = (y <= Real(0.0)) & (Real(0.0) <= y);
  return core::select(is_zero, Real(1.0), formula_exp<Real>(y * formula_log<Real>(x)));
}

/// x^n by repeated multiplication.
template <class Real>
[[gnu::always_inline]] inline Real formula_whole_power(Real x, unsigned n) {
  Real power(1.0);
  for (; n > 1; n >>= 1) {
    if ((n & 1U) != 0) power = power * x;
    x = x * x;
  }
  return n == 1 ? power * x : power;
}

/// The smaller and the larger one, NaN where either is.
template <class Real>
[[gnu::always_inline]] inline Real formula_min(const Real& a, const Real& b) {
  const Real smaller = core::select(b < a, b, a);
  return core::select(b <= b, smaller, b);
}
template <class Real>
[[gnu::always_inline]] inline Real formula_max(const Real& a, const Real& b) {
  const Real larger = core::select(a < b, b, a);
  return core::select(b <= b, larger, b);
}

/// The median, NaN where a component is.
template <class Real, std::size_t P>
[[gnu::always_inline]] inline Real formula_median(const core::Vector<Real, P>& values) {
  core::Mask<Real> numbers = values[0] <= values[0];
  core::unroll<P - 1>([&](auto i) { numbers = numbers & (values[i + 1] <= values[i + 1]); });
  return core::select(numbers, median_of(values), Real(formula_nan));
}

/// (v_1 ... v_p)^(1/p): 0 where a component is, NaN where one is negative.
template <class Real, std::size_t P>
[[gnu::always_inline]] inline Real formula_geometric_mean(const core::Vector<Real, P>& values) {
  // So that no product of four leaves the normal numbers.
  core::Mask<Real> usual = !(Real(1.0) < Real(0.0));
  core::unroll<P>([&](auto i) { usual = usual & (values[i] > Real(0x1p-255)) & (values[i] < Real(0x1p255)); });
  const Real fast = core::reciprocal(inverse_geometric_mean(values));
  if (!core::any(!usual)) return fast;
  Real sum(0.0);
  for (std::size_t i = 0; i < P; ++i) sum = sum + formula_log<Real>(values[i]);
  return core::select(usual, fast, formula_exp<Real>(sum * Real(1.0 / static_cast<double>(P))));
}

}  // namespace ridgeloc::solvers
