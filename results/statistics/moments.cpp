#include "results/statistics/moments.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "results/statistics/lanes.hpp"

namespace ridgeloc::results {
namespace {

/// First admitted value. Sums are taken about it: equal values then give exactly their value and zero spread.
double origin_of(std::span<const double> values) {
  for (const double value : values) {
    if (std::fabs(value) <= largest_moment_value) return value;
  }
  return 0.0;
}

double total(const std::array<double, lanes>& v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

/// The sign is dropped so that one comparison says whether a value enters the moments: baseline x86-64 combines two
/// badly. NaN compares false and stays out.
template <std::size_t width>
[[gnu::always_inline]] inline void drop_sign(typename Lanes<width>::Register& part) {
  const auto bits = reinterpret_cast<typename Lanes<width>::Bits>(part);
  part = reinterpret_cast<typename Lanes<width>::Register>(bits & std::numeric_limits<std::int64_t>::max());
}

/// The count is exact as a double: a column has less than 2^53 values.
template <std::size_t width>
struct SumAboutOrigin {
  double origin;
  Lanes<width> sum{}, count{};

  [[gnu::always_inline]] void add(const double* group) {
    using Register = typename Lanes<width>::Register;
    for (std::size_t r = 0; r < Lanes<width>::registers; ++r) {
      Register value;
      Lanes<width>::load(value, group, r);
      const Register shifted = value - origin;
      drop_sign<width>(value);
      sum.parts[r] += value <= largest_moment_value ? shifted : Register{};
      count.parts[r] += value <= largest_moment_value ? Register{} + 1.0 : Register{};
    }
  }
};

template <std::size_t width>
struct CentralSums {
  double mean;
  Lanes<width> m2{}, m3{}, m4{};

  [[gnu::always_inline]] void add(const double* group) {
    using Register = typename Lanes<width>::Register;
    for (std::size_t r = 0; r < Lanes<width>::registers; ++r) {
      Register value;
      Lanes<width>::load(value, group, r);
      const Register shifted = value - mean;
      drop_sign<width>(value);
      const Register d = value <= largest_moment_value ? shifted : Register{};
      const Register d2 = d * d;
      m2.parts[r] += d2;
      m3.parts[r] += d2 * d;
      m4.parts[r] += d2 * d2;
    }
  }
};

template <std::size_t width>
struct TwoPasses {
  [[gnu::always_inline]] static Moments run(std::span<const double> values) {
    SumAboutOrigin<width> first{origin_of(values)};
    for_each_group(values, first);
    const double n = total(first.count.values());
    if (n == 0.0) return {};

    CentralSums<width> second{first.origin + total(first.sum.values()) / n};
    for_each_group(values, second);
    return {static_cast<std::uint64_t>(n), second.mean, total(second.m2.values()), total(second.m3.values()),
            total(second.m4.values())};
  }
};

}  // namespace

Moments moments_of(std::span<const double> values, InstructionSet set) {
  return run_with<TwoPasses>(set, values);
}

Moments merge(const Moments& a, const Moments& b) {
  if (a.n == 0) return b;
  if (b.n == 0) return a;
  const double na = static_cast<double>(a.n);
  const double nb = static_cast<double>(b.n);
  const double n = na + nb;
  const double pa = na / n;
  const double pb = nb / n;
  const double delta = b.mean - a.mean;
  const double delta2 = delta * delta;

  Moments c;
  c.n = a.n + b.n;
  c.mean = a.mean + delta * pb;
  c.m2 = a.m2 + b.m2 + delta2 * na * pb;
  c.m3 = a.m3 + b.m3 + delta2 * delta * na * pb * (pa - pb) + 3.0 * delta * (pa * b.m2 - pb * a.m2);
  c.m4 = a.m4 + b.m4 + delta2 * delta2 * na * pb * (pa * pa - pa * pb + pb * pb) +
         6.0 * delta2 * (pa * pa * b.m2 + pb * pb * a.m2) + 4.0 * delta * (pa * b.m3 - pb * a.m3);
  return c;
}

}  // namespace ridgeloc::results
