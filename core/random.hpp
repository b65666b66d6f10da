#pragma once

#include <array>
#include <cstdint>

#include "core/elementary.hpp"
#include "core/stream.hpp"

/// Distributions: from random bits to numbers. All of them are our own, since the standard library's differ between
/// implementations.
namespace ridgeloc::core {

/// Uniform on (0, 1) on the grid (k + 1/2) 2^-52 from 52 of 64 random bits: never 0, never 1.
inline double uniform(std::uint32_t low, std::uint32_t high) {
  const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 12;
  return (static_cast<double>(bits) + 0.5) * 0x1p-52;
}

/// Two uniforms on (0, 1) from one random block.
inline std::array<double, 2> uniform_pair(const RandomBlock& b) {
  return {uniform(b[0], b[1]), uniform(b[2], b[3])};
}

/// Two uniforms on (0, 1) from draw `draw`, a whole number, of each lane's trial first_trial + trial.
inline std::array<double, 2> uniform_pair(const Stream& stream, std::uint64_t first_trial, std::size_t trial,
                                          double draw) {
  return uniform_pair(stream.block(first_trial + trial, static_cast<std::uint64_t>(draw)));
}

/// Three uniforms on (0, 1) on the grid (k + 1/2) 2^-42 from one random block: one word each, and ten bits each of the
/// fourth word.
inline std::array<double, 3> uniform_triple(const RandomBlock& b) {
  std::array<double, 3> u;
  for (unsigned i = 0; i < 3; ++i) {
    const std::uint64_t bits = std::uint64_t{b[i]} << 10 | (b[3] >> (10 * i) & 0x3ffU);
    u[i] = (static_cast<double>(bits) + 0.5) * 0x1p-42;
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
  const Real z = Real(2.0) * u[0] - Real(1.0);
  const Real r = sqrt(max(Real(1.0) - z * z, Real(0.0)));
  const SinCos<Real> angle = sin_cos_turns(u[1]);
  return {r * angle.cos, r * angle.sin, z};
}

}  // namespace ridgeloc::core
