#include "results/moments.hpp"

#include <array>
#include <bit>
#include <cstddef>

namespace ridgeloc::results {
namespace {

/// Value i goes to accumulator i % lanes, whatever the width of the machine's registers.
constexpr std::size_t lanes = 8;

using Lanes = std::array<double, lanes>;

constexpr std::uint64_t magnitude_mask = ~(std::uint64_t{1} << 63);
constexpr std::uint64_t largest_magnitude = std::bit_cast<std::uint64_t>(largest_moment_value);

/// All bits set where the value enters the moments. The bit patterns of non-negative doubles are ordered like
/// the doubles themselves, with infinity and every NaN above all finite ones, so one integer comparison
/// decides; the subtraction's sign bit is that comparison without a branch (both operands are below 2^63).
std::uint64_t admission_mask(double value) {
  const std::uint64_t magnitude = std::bit_cast<std::uint64_t>(value) & magnitude_mask;
  return ((largest_magnitude - magnitude) >> 63) - 1;
}

double masked(double value, std::uint64_t mask) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & mask);
}

double total(const Lanes& v) {
  return ((v[0] + v[1]) + (v[2] + v[3])) + ((v[4] + v[5]) + (v[6] + v[7]));
}

/// Calls visit(value, lane) in trial order; the whole groups first, so that they vectorize.
template <typename Visit>
void for_each_lane(std::span<const double> values, Visit visit) {
  const std::size_t whole = values.size() / lanes * lanes;
  for (std::size_t i = 0; i < whole; i += lanes) {
    for (std::size_t lane = 0; lane < lanes; ++lane) visit(values[i + lane], lane);
  }
  for (std::size_t i = whole; i < values.size(); ++i) visit(values[i], i - whole);
}

}  // namespace

Moments moments_of(std::span<const double> values) {
  // Sums are taken about a first admitted value: equal values then give exactly their value and zero spread.
  double origin = 0.0;
  for (const double value : values) {
    if (admission_mask(value) != 0) {
      origin = value;
      break;
    }
  }

  Lanes sum{};
  std::array<std::uint64_t, lanes> count{};
  for_each_lane(values, [&](double value, std::size_t lane) {
    const std::uint64_t mask = admission_mask(value);
    sum[lane] += masked(value - origin, mask);
    count[lane] -= mask;  // the mask is -1 as an integer
  });

  Moments moments;
  for (const std::uint64_t c : count) moments.n += c;
  if (moments.n == 0) return moments;
  moments.mean = origin + total(sum) / static_cast<double>(moments.n);

  Lanes m2{};
  Lanes m3{};
  Lanes m4{};
  for_each_lane(values, [&](double value, std::size_t lane) {
    const double d = masked(value - moments.mean, admission_mask(value));
    const double d2 = d * d;
    m2[lane] += d2;
    m3[lane] += d2 * d;
    m4[lane] += d2 * d2;
  });
  moments.m2 = total(m2);
  moments.m3 = total(m3);
  moments.m4 = total(m4);
  return moments;
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
