#pragma once

#include "core/real.hpp"

/// From a rough seed to the correctly rounded value, by fused multiply-adds alone: faster than the divider and the
/// square root unit of processors with 512-bit registers. Seeds differ between makers of processors. What is made of
/// them here does not, as long as they are within 2^-14 of the value (relative) and have 27 significant bits at most.
/// Why this suffices: docs/decisions/0010-simd-packs.md.
namespace ridgeloc::core {

/// 1 / x, correctly rounded, for 2^-1000 < |x| < 2^1000, from y within 2^-28 of it (relative).
///
/// Newton's method, y <- y + y (1 - x y), twice. The last step rounds correctly from any y within one unit in the last
/// place, unless the fraction of x is all ones (Markstein 1990): then only from a y above 1 / x. The step before, whose
/// own error is below 2^-56, is therefore made 2^-55 too long.
template <class Real>
[[gnu::always_inline]] inline Real finish_reciprocal(const Real& x, Real y) {
  y = mul_add(y, neg_mul_add(x, y, Real(1.0)) + Real(0x1p-55), y);
  return mul_add(y, neg_mul_add(x, y, Real(1.0)), y);
}

/// 1 / x for 2^-1000 < |x| < 2^1000.
template <class Real>
[[gnu::always_inline]] inline Real refine_reciprocal(const Real& x, const Real& seed) {
  return finish_reciprocal(x, mul_add(seed, neg_mul_add(x, seed, Real(1.0)), seed));
}

/// sqrt(x) and the reciprocal of that for 2^-960 < x < 2^1000 from a seed of 1 / sqrt(x). Goldschmidt's method:
/// g -> sqrt(x) and h -> 1 / (2 sqrt(x)) together.
template <class Real>
[[gnu::always_inline]] inline RootAndInverse<Real> refine_root_and_inverse(const Real& x, const Real& seed) {
  Real g = x * seed;
  Real h = Real(0.5) * seed;
  for (int step = 0; step < 2; ++step) {
    const Real r = neg_mul_add(g, h, Real(0.5));
    g = mul_add(g, r, g);
    h = mul_add(h, r, h);
  }
  const Real root = mul_add(neg_mul_add(g, g, x), h, g);
  return {root, finish_reciprocal(root, h + h)};
}

}  // namespace ridgeloc::core
