#pragma once

#include "core/real.hpp"

/// From a rough seed to the correctly rounded value, by fused multiply-adds alone: faster than the divider and the
/// square root unit of processors with 512-bit registers. Seeds differ between makers of processors. What is made of
/// them here does not, as long as they are within 2^-14 of the value (relative): every error of the seed is squared
/// away before the last step, which rounds once. Only a reciprocal of a number whose fraction is all ones comes out one
/// unit in the last place low (Markstein 1990), whatever the seed.
namespace ridgeloc::core {

/// 1 / x for 2^-1000 < |x| < 2^1000. Newton's method, y <- y + y (1 - x y).
template <class Real>
Real refine_reciprocal(Real x, Real seed) {
  Real y = seed;
  for (int step = 0; step < 3; ++step) y = mul_add(y, neg_mul_add(x, y, Real(1.0)), y);
  return y;
}

/// sqrt(x) and the reciprocal of that for 2^-1000 < x < 2^1000 from a seed of 1 / sqrt(x). Goldschmidt's method:
/// g -> sqrt(x) and h -> 1 / (2 sqrt(x)) together.
template <class Real>
RootAndInverse<Real> refine_root_and_inverse(Real x, Real seed) {
  Real g = x * seed;
  Real h = Real(0.5) * seed;
  for (int step = 0; step < 2; ++step) {
    const Real r = neg_mul_add(g, h, Real(0.5));
    g = mul_add(g, r, g);
    h = mul_add(h, r, h);
  }
  const Real root = mul_add(neg_mul_add(g, g, x), h, g);
  const Real inverse = h + h;
  return {root, mul_add(inverse, neg_mul_add(root, inverse, Real(1.0)), inverse)};
}

}  // namespace ridgeloc::core
