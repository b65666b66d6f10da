#pragma once

// The smallest thing that a SIMD pack can be: two doubles with a mask each. It holds the promise that kernels are
// written once over `Real`: what does not compile or answer alike here would not on a pack.

#include <array>
#include <cstdint>
#include <span>

#include "core/real.hpp"

namespace ridgeloc::tests {

struct Lanes {
  std::array<double, 2> v{};
  Lanes() = default;
  explicit Lanes(double x) : v{x, x} {}
  Lanes(double a, double b) : v{a, b} {}
};

struct LaneMask {
  std::array<bool, 2> v{};
};

template <class F>
Lanes each(F f) {
  return {f(0U), f(1U)};
}
template <class F>
LaneMask ask(F f) {
  return {{f(0U), f(1U)}};
}

inline Lanes operator+(Lanes a, Lanes b) {
  return each([&](auto i) { return a.v[i] + b.v[i]; });
}
inline Lanes operator-(Lanes a, Lanes b) {
  return each([&](auto i) { return a.v[i] - b.v[i]; });
}
inline Lanes operator*(Lanes a, Lanes b) {
  return each([&](auto i) { return a.v[i] * b.v[i]; });
}
inline Lanes operator/(Lanes a, Lanes b) {
  return each([&](auto i) { return a.v[i] / b.v[i]; });
}
inline Lanes operator-(Lanes a) {
  return each([&](auto i) { return -a.v[i]; });
}
inline LaneMask operator<(Lanes a, Lanes b) {
  return ask([&](auto i) { return a.v[i] < b.v[i]; });
}
inline LaneMask operator>(Lanes a, Lanes b) {
  return ask([&](auto i) { return a.v[i] > b.v[i]; });
}
inline LaneMask operator<=(Lanes a, Lanes b) {
  return ask([&](auto i) { return a.v[i] <= b.v[i]; });
}
inline LaneMask operator&(LaneMask a, LaneMask b) {
  return ask([&](auto i) { return a.v[i] && b.v[i]; });
}
inline LaneMask operator|(LaneMask a, LaneMask b) {
  return ask([&](auto i) { return a.v[i] || b.v[i]; });
}
inline LaneMask operator!(LaneMask a) {
  return ask([&](auto i) { return !a.v[i]; });
}

}  // namespace ridgeloc::tests

namespace ridgeloc::core {

template <>
struct RealTraits<tests::Lanes> {
  using Mask = tests::LaneMask;
  using Index = std::array<std::size_t, 2>;
};

inline tests::Lanes select(tests::LaneMask m, tests::Lanes a, tests::Lanes b) {
  return tests::each([&](auto i) { return m.v[i] ? a.v[i] : b.v[i]; });
}
inline bool any(tests::LaneMask m) {
  return m.v[0] || m.v[1];
}
inline tests::Lanes sqrt(tests::Lanes a) {
  return tests::each([&](auto i) { return sqrt(a.v[i]); });
}
inline tests::Lanes abs(tests::Lanes a) {
  return tests::each([&](auto i) { return abs(a.v[i]); });
}
inline tests::Lanes max(tests::Lanes a, tests::Lanes b) {
  return tests::each([&](auto i) { return max(a.v[i], b.v[i]); });
}
inline tests::LaneMask is_finite(tests::Lanes a) {
  return tests::ask([&](auto i) { return is_finite(a.v[i]); });
}
inline tests::Lanes round_to_integer(tests::Lanes a) {
  return tests::each([&](auto i) { return round_to_integer(a.v[i]); });
}
inline tests::Lanes cube_root_guess(tests::Lanes a) {
  return tests::each([&](auto i) { return cube_root_guess(a.v[i]); });
}
inline tests::Lanes load(std::span<const double> column, const std::array<std::size_t, 2>& trial) {
  return tests::each([&](auto i) { return column[trial[i]]; });
}
inline void store(std::span<double> column, const std::array<std::size_t, 2>& trial, tests::Lanes value) {
  for (std::size_t i = 0; i < 2; ++i) column[trial[i]] = value.v[i];
}
inline void store_status(std::span<std::uint8_t> column, const std::array<std::size_t, 2>& trial, tests::Lanes code) {
  for (std::size_t i = 0; i < 2; ++i) column[trial[i]] = static_cast<std::uint8_t>(code.v[i]);
}
}  // namespace ridgeloc::core

// Kernels find the functions above because they are declared before them; hence the place of this include.
#include "core/random.hpp"

namespace ridgeloc::core {

inline std::array<tests::Lanes, 2> uniform_pair(const Stream& stream, std::uint64_t first_trial,
                                                const std::array<std::size_t, 2>& trial, tests::Lanes draw) {
  const auto a = uniform_pair(stream, first_trial, trial[0], draw.v[0]);
  const auto b = uniform_pair(stream, first_trial, trial[1], draw.v[1]);
  return {tests::Lanes(a[0], b[0]), tests::Lanes(a[1], b[1])};
}

}  // namespace ridgeloc::core
