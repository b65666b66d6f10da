#include "results/statistics/instruction_set.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <vector>

#include "results/statistics/extremes.hpp"
#include "results/statistics/statistics.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/same_bits.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;
using tests::infinity;
using tests::not_a_number;

using Accumulators = std::array<double, 8>;

double total(const Accumulators& s) {
  return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

bool admitted(double value) {
  return std::abs(value) <= largest_moment_value;
}

/// The definition of the moments, one value at a time.
Moments plain_moments(const std::vector<double>& values) {
  Moments moments;
  double origin = 0.0;
  for (const double value : values) {
    if (admitted(value) && moments.n++ == 0) origin = value;
  }
  if (moments.n == 0) return moments;
  Accumulators sum{}, m2{}, m3{}, m4{};
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (admitted(values[i])) sum[i % 8] += values[i] - origin;
  }
  moments.mean = origin + total(sum) / static_cast<double>(moments.n);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!admitted(values[i])) continue;
    const double d = values[i] - moments.mean;
    m2[i % 8] += d * d;
    m3[i % 8] += d * d * d;
    m4[i % 8] += (d * d) * (d * d);
  }
  moments.m2 = total(m2);
  moments.m3 = total(m3);
  moments.m4 = total(m4);
  return moments;
}

/// By accumulators too: they decide which zero stands for zeros of both signs.
Extremes plain_extremes(const std::vector<double>& values) {
  Accumulators low, high;
  low.fill(infinity);
  high.fill(-infinity);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] < low[i % 8]) low[i % 8] = values[i];
    if (values[i] > high[i % 8]) high[i % 8] = values[i];
  }
  return {*std::min_element(low.begin(), low.end()), *std::max_element(high.begin(), high.end())};
}

Histogram plain_histogram(const std::vector<double>& values) {
  std::map<std::uint32_t, std::uint64_t> counts;
  for (const double value : values) {
    if (!std::isnan(value)) ++counts[Histogram::bin_of(value)];
  }
  std::vector<Histogram::Bin> bins;
  for (const auto& [number, count] : counts) bins.push_back({number, count});
  return Histogram(std::move(bins));
}

using tests::same_bits;

bool same_bits(const Moments& a, const Moments& b) {
  return a.n == b.n && same_bits(a.mean, b.mean) && same_bits(a.m2, b.m2) && same_bits(a.m3, b.m3) &&
         same_bits(a.m4, b.m4);
}

void check_against_definition(const std::vector<double>& values, InstructionSet set) {
  const MetricStatistics statistics = statistics_of(values, set);
  const Extremes extremes = plain_extremes(values);
  const Histogram histogram = plain_histogram(values);
  CHECK(same_bits(statistics.moments, plain_moments(values)));
  CHECK(same_bits(statistics.min, extremes.min));
  CHECK(same_bits(statistics.max, extremes.max));
  CHECK(statistics.histogram == histogram);
  CHECK(statistics.beyond == histogram.total() - statistics.moments.n);
}

/// Values at and beside every bound that the loops compare with, and NaN of every kind.
const std::vector<double> special = {
    0.0,
    -0.0,
    5e-324,
    -1.0,
    1e300,
    -1e300,
    infinity,
    -infinity,
    not_a_number,
    -not_a_number,
    std::bit_cast<double>(std::uint64_t{0x7ff0000000000001}),  // its upper half is that of infinity
    std::bit_cast<double>(std::uint64_t{0xfff0000000000001}),
    largest_moment_value,
    -largest_moment_value,
    std::nextafter(largest_moment_value, infinity),
    std::nextafter(-largest_moment_value, -infinity),
    0x1p-40,
    std::nextafter(0x1p-40, 0.0),
    0x1p20,
    std::nextafter(0x1p20, 0.0)};

/// Columns of one length as studies have them, and worse.
std::vector<std::vector<double>> columns(std::size_t n) {
  std::mt19937_64 engine(n);
  std::lognormal_distribution<double> error(0.0, 1.0);
  std::normal_distribution<double> signed_error(0.0, 1.0);
  std::poisson_distribution<int> iterations(3.0);
  std::vector<std::vector<double>> columns(8, std::vector<double>(n));
  for (std::size_t i = 0; i < n; ++i) {
    columns[0][i] = error(engine);
    columns[1][i] = signed_error(engine);
    columns[2][i] = iterations(engine);
    columns[3][i] = engine() % 2 == 0 ? error(engine) : not_a_number;
    columns[4][i] = 0.1;
    columns[5][i] = not_a_number;
    columns[6][i] = special[engine() % special.size()];
    columns[7][i] = std::bit_cast<double>(engine());
  }
  return columns;
}

std::vector<InstructionSet> supported_sets() {
  std::vector<InstructionSet> sets = {InstructionSet::Baseline};
  if (is_supported(InstructionSet::Avx2)) sets.push_back(InstructionSet::Avx2);
  return sets;
}

TEST_CASE("the best instruction set is one that the machine runs") {
  CHECK(is_supported(InstructionSet::Baseline));
  CHECK(is_supported(best_instruction_set()));
}

TEST_CASE("statistics are the bits of their definition in every instruction set and length") {
  for (const InstructionSet set : supported_sets()) {
    for (const std::size_t n : {0U, 1U, 7U, 8U, 9U, 15U, 16U, 17U, 1023U, 1024U, 1025U, 4095U, 4096U, 4097U}) {
      const std::vector<std::vector<double>> all = columns(n);
      for (std::size_t c = 0; c < all.size(); ++c) {
        INFO("set " << static_cast<int>(set) << ", n = " << n << ", column " << c);
        check_against_definition(all[c], set);
      }
    }
  }
}

TEST_CASE("statistics are the bits of their definition with any value in any place") {
  for (const InstructionSet set : supported_sets()) {
    for (const double value : special) {
      for (std::size_t place = 0; place < 17; ++place) {
        std::vector<double> values = columns(17)[0];
        values[place] = value;
        INFO("set " << static_cast<int>(set) << ", value " << value << " at " << place);
        check_against_definition(values, set);
      }
    }
  }
}

}  // namespace
