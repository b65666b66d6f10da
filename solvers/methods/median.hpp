#pragma once

#include <cstddef>

#include "core/real.hpp"

namespace ridgeloc::solvers {

/// Sorts `count` values of every lane in ascending order, value i in from[i * lanes] and after: Batcher's merge
/// exchange (Knuth, The Art of Computer Programming, vol. 3, 5.2.2 M), which compares the same places whatever the
/// values.
template <class Real>
void sort_lanes(double* values, std::size_t count) {
  constexpr std::size_t lanes = core::lanes<Real>;
  const auto exchange = [values](std::size_t i, std::size_t j) {
    const Real a = core::load<Real>(values + i * lanes);
    const Real b = core::load<Real>(values + j * lanes);
    const core::Mask<Real> ordered = a < b;
    core::store(values + i * lanes, core::select(ordered, a, b));
    core::store(values + j * lanes, core::select(ordered, b, a));
  };
  std::size_t half = 1;
  while (2 * half < count) half *= 2;
  for (std::size_t p = half; p > 0; p /= 2) {
    std::size_t q = half;
    std::size_t r = 0;
    for (std::size_t d = p;; d = q - p, q /= 2, r = p) {
      for (std::size_t i = 0; i + d < count; ++i) {
        if ((i & p) == r) exchange(i, i + d);
      }
      if (q == p) break;
    }
  }
}

/// The median of every lane; reorders the values. Precondition: count > 0.
template <class Real>
Real median(double* values, std::size_t count) {
  constexpr std::size_t lanes = core::lanes<Real>;
  sort_lanes<Real>(values, count);
  const Real upper = core::load<Real>(values + count / 2 * lanes);
  if (count % 2 == 1) return upper;
  return Real(0.5) * (core::load<Real>(values + (count / 2 - 1) * lanes) + upper);
}

}  // namespace ridgeloc::solvers
