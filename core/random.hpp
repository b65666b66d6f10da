#pragma once

#include <array>
#include <cstdint>

#include "core/elementary.hpp"
#include "core/stream.hpp"

/// Distributions: from random bits to numbers. All of them are our own, since the standard library's differ between
/// implementations.
namespace ridgeloc::core {

/// Uniform on (0, 1) on the grid (k + 1/2) 2^-52 from the 52 upper bits of two words: never 0, never 1. The bits become
/// the fraction of a number in [1, 2), so that every operation is exact.
template <class Real = double>
Real uniform(const Words<Real>& low, const Words<Real>& high) {
  const Words<Real> fraction = ((low << 32) >> 44) | ((high << 32) >> 12);
  return (from_bits(fraction | bits_of(Real(1.0))) - Real(1.0)) + Real(0x1p-53);
}

/// Two uniforms on (0, 1) from one random block.
template <class Real = double>
std::array<Real, 2> uniform_pair(const RandomBlock<Words<Real>>& b) {
  return {uniform<Real>(b[0], b[1]), uniform<Real>(b[2], b[3])};
}

/// Three uniforms on (0, 1) on the grid (k + 1/2) 2^-42 from one random block: one word each, and ten bits each of the
/// fourth word.
template <class Real = double>
std::array<Real, 3> uniform_triple(const RandomBlock<Words<Real>>& b) {
  std::array<Real, 3> u;
  for (int i = 0; i < 3; ++i) {
    const Words<Real> ten_bits = (b[3] >> (10 * i)) & Words<Real>(0x3ffU);
    const Words<Real> fraction = ((b[static_cast<std::size_t>(i)] << 32) >> 12) | (ten_bits << 10);
    u[static_cast<std::size_t>(i)] = (from_bits(fraction | bits_of(Real(1.0))) - Real(1.0)) + Real(0x1p-43);
  }
  return u;
}

/// Two independent standard normals from two uniforms (Box and Muller 1958):
/// sqrt(-2 log u0) (cos 2 pi u1, sin 2 pi u1). The largest possible size is 8.6.
template <class Real>
std::array<Real, 2> normal_pair(const std::array<Real, 2>& u) {
  const Real radius = sqrt(Real(-2.0) * log(u[0]));
  const SinCos<Real> angle = sin_cos_turns(u[1]);
  return {radius * angle.cos, radius * angle.sin};
}

/// A direction uniform on the unit sphere from two uniforms (Archimedes): z = 2 u0 - 1, longitude 2 pi u1.
template <class Real>
std::array<Real, 3> unit_vector(const std::array<Real, 2>& u) {
  const Real z = mul_add(Real(2.0), u[0], Real(-1.0));
  const Real r = sqrt(max(neg_mul_add(z, z, Real(1.0)), Real(0.0)));
  const SinCos<Real> angle = sin_cos_turns(u[1]);
  return {r * angle.cos, r * angle.sin, z};
}

}  // namespace ridgeloc::core
