#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>

namespace ridgeloc::results {

/// Value i of a column goes to accumulator i % lanes, whatever the width of the machine's registers.
inline constexpr std::size_t lanes = 8;

/// Eight numbers as registers of some width, by the vector types of GCC and Clang. Plain arrays would say the same, but
/// compilers do not reliably keep them in registers. Comparing two registers gives a mask for `mask ? a : b`, which
/// picks lane by lane.
template <std::size_t register_bytes>
struct Lanes {
  static constexpr std::size_t per_register = register_bytes / sizeof(double);
  static constexpr std::size_t registers = lanes / per_register;

  typedef double Register __attribute__((vector_size(register_bytes)));
  typedef std::int64_t Bits __attribute__((vector_size(register_bytes)));

  Register parts[registers] = {};

  [[gnu::always_inline]] void fill(double value) {
    for (Register& part : parts) part = Register{} + value;
  }

  [[gnu::always_inline]] static void load(Register& part, const double* group, std::size_t index) {
    std::memcpy(&part, group + index * per_register, sizeof part);
  }

  [[gnu::always_inline]] std::array<double, lanes> values() const {
    std::array<double, lanes> v;
    std::memcpy(v.data(), parts, sizeof parts);
    return v;
  }
};

/// Hands the values to `reduction.add` in groups of eight. NaN fills the last group up, so a reduction must pass over
/// NaN without a trace.
template <typename Reduction>
[[gnu::always_inline]] inline void for_each_group(std::span<const double> values, Reduction& reduction) {
  const std::size_t whole = values.size() / lanes * lanes;
  for (std::size_t i = 0; i < whole; i += lanes) reduction.add(values.data() + i);
  if (whole == values.size()) return;
  std::array<double, lanes> last;
  last.fill(std::numeric_limits<double>::quiet_NaN());
  std::copy(values.begin() + static_cast<std::ptrdiff_t>(whole), values.end(), last.begin());
  reduction.add(last.data());
}

}  // namespace ridgeloc::results
