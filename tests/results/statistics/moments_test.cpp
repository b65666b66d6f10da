#include "results/statistics/moments.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"

namespace {

using namespace ridgeloc::results;
using ridgeloc::tests::infinity;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Reference {
  long double mean = 0, m2 = 0, m3 = 0, m4 = 0;
};

Reference reference(const std::vector<double>& values) {
  Reference r;
  for (const double v : values) r.mean += v;
  r.mean /= static_cast<long double>(values.size());
  for (const double v : values) {
    const long double d = v - r.mean;
    r.m2 += d * d;
    r.m3 += d * d * d;
    r.m4 += d * d * d * d;
  }
  return r;
}

std::vector<double> sample(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(3.0, 2.0);
  std::vector<double> values(n);
  for (double& value : values) value = normal(engine);
  return values;
}

/// A sum of n terms is off by at most n eps times the sum of their sizes; M3 cancels, so its size is that of
/// M4's root terms: |d|^3 <= 1 + d^4 summed.
void check_against(const Moments& moments, const std::vector<double>& values) {
  const Reference exact = reference(values);
  const double n = static_cast<double>(values.size());
  const double rounding = 8.0 * n * epsilon;
  CHECK(moments.n == values.size());
  CHECK(std::abs(moments.mean - static_cast<double>(exact.mean)) <= rounding * (std::abs(moments.mean) + 1.0));
  CHECK(std::abs(moments.m2 - static_cast<double>(exact.m2)) <= rounding * (moments.m2 + 1.0));
  CHECK(std::abs(moments.m3 - static_cast<double>(exact.m3)) <= rounding * (n + moments.m4));
  CHECK(std::abs(moments.m4 - static_cast<double>(exact.m4)) <= rounding * (moments.m4 + 1.0));
}

TEST_CASE("moments of a sample worked by hand") {
  // 1, 2, 6: mean 3, deviations -2, -1, 3.
  const std::vector<double> values = {1.0, 2.0, 6.0};
  const Moments moments = moments_of(values);
  CHECK(moments == Moments{3, 3.0, 14.0, 18.0, 98.0});
}

TEST_CASE("moments of no values are empty") {
  CHECK(moments_of({}) == Moments{});
  CHECK(moments_of(std::vector<double>{std::numeric_limits<double>::quiet_NaN()}) == Moments{});
}

TEST_CASE("moments of every length around the accumulator count agree with a long double reference") {
  for (const std::size_t n : {1U, 2U, 7U, 8U, 9U, 15U, 16U, 17U, 4096U}) {
    INFO("n = " << n);
    check_against(moments_of(sample(n, n)), sample(n, n));
  }
}

TEST_CASE("moments pass over NaN, infinite and oversized values, wherever they stand") {
  const double limit = largest_moment_value;
  const double outsiders[] = {
      std::numeric_limits<double>::quiet_NaN(), -std::numeric_limits<double>::quiet_NaN(), infinity, -infinity,
      std::nextafter(limit, infinity),          -std::nextafter(limit, infinity)};
  for (const double outsider : outsiders) {
    for (std::size_t place = 0; place < 12; ++place) {
      std::vector<double> values(11, 0.0);
      for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
      values.insert(values.begin() + static_cast<std::ptrdiff_t>(place), outsider);
      const Moments moments = moments_of(values);
      CHECK(moments.n == 11);
      CHECK(moments.mean == Approx(5.0));
      CHECK(moments.m2 == Approx(110.0));
    }
  }
  CHECK(moments_of(std::vector{limit, -limit}).n == 2);
}

TEST_CASE("equal values have exactly their value and no spread") {
  for (const double value : {0.1, 1.0 / 3.0, 123456.789, -7e-9, 0.0}) {
    const Moments moments = moments_of(std::vector<double>(4097, value));
    CHECK(moments == Moments{4097, value, 0.0, 0.0, 0.0});
    CHECK(merge(moments, moments) == Moments{8194, value, 0.0, 0.0, 0.0});
  }
}

TEST_CASE("merging equals the moments of the union") {
  const std::vector<double> values = sample(1000, 5);
  for (const std::size_t cut : {1U, 10U, 500U, 999U}) {
    const std::span<const double> all(values);
    check_against(merge(moments_of(all.first(cut)), moments_of(all.subspan(cut))), values);
  }
}

TEST_CASE("merging with nothing changes no bit") {
  const Moments moments = moments_of(sample(100, 9));
  CHECK(merge(moments, Moments{}) == moments);
  CHECK(merge(Moments{}, moments) == moments);
}

}  // namespace
