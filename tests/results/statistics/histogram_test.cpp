#include "results/statistics/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "tests/support/catch.hpp"

namespace {

using namespace ridgeloc::results;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Histogram histogram_of(const std::vector<double>& values) {
  Histogram histogram;
  histogram.add(values);
  return histogram;
}

TEST_CASE("each bin begins at its lower edge and ends before the next") {
  for (std::uint32_t bin = 1; bin < Histogram::bins; ++bin) {
    const double edge = Histogram::lower_edge(bin);
    REQUIRE(Histogram::bin_of(edge) == bin);
    REQUIRE(Histogram::bin_of(std::nextafter(edge, 0.0)) == bin - 1);
  }
  CHECK(Histogram::lower_edge(0) == 0.0);
  CHECK(Histogram::lower_edge(1) == std::ldexp(1.0, Histogram::lowest_octave));
  CHECK(Histogram::lower_edge(Histogram::bins - 1) == std::ldexp(1.0, Histogram::highest_octave));
  CHECK(Histogram::lower_edge(Histogram::bins) == infinity);
}

TEST_CASE("values off the grid fall into the end bins") {
  for (const double small : {0.0, -0.0, 5e-324, 1e-13, -1.0, -infinity}) CHECK(Histogram::bin_of(small) == 0);
  for (const double large : {1.1e6, 1e300, infinity}) CHECK(Histogram::bin_of(large) == Histogram::bins - 1);
}

TEST_CASE("the integers 1 to 64 have bins of their own") {
  std::set<std::uint32_t> bins;
  for (int i = 1; i <= 64; ++i) bins.insert(Histogram::bin_of(i));
  CHECK(bins.size() == 64);
}

TEST_CASE("NaN is not counted, of either sign") {
  CHECK(histogram_of({nan, -nan}) == Histogram{});
  CHECK(histogram_of({1.0, nan, infinity, -nan}).total() == 2);
}

TEST_CASE("only the range in use is kept") {
  const Histogram histogram = histogram_of({4.0, 1.0, 4.0});
  CHECK(histogram.first_bin() == Histogram::bin_of(1.0));
  CHECK(histogram.counts().size() == 2 * Histogram::bins_per_octave + 1);
  CHECK(histogram.counts().front() == 1);
  CHECK(histogram.counts().back() == 2);
}

TEST_CASE("merging gives the histogram of the union, in any order") {
  const std::vector<double> low = {0.0, 1e-3, 2e-3};
  const std::vector<double> high = {5.0, 7.0, infinity};
  const Histogram both = histogram_of({0.0, 1e-3, 2e-3, 5.0, 7.0, infinity});
  Histogram forward = histogram_of(low);
  forward.merge(histogram_of(high));
  Histogram backward = histogram_of(high);
  backward.merge(histogram_of(low));
  Histogram added = histogram_of(low);
  added.add(high);
  CHECK(forward == both);
  CHECK(backward == both);
  CHECK(added == both);
  Histogram with_nothing = both;
  with_nothing.merge(Histogram{});
  CHECK(with_nothing == both);
  Histogram nothing;
  nothing.merge(both);
  CHECK(nothing == both);
}

TEST_CASE("a histogram is what its first bin and counts say, and refuses counts beyond the last bin") {
  const Histogram made = histogram_of({3.0, 3.1, 9.0});
  CHECK(Histogram(made.first_bin(), made.counts()) == made);
  CHECK_NOTHROW(Histogram(Histogram::bins - 1, {1}));
  CHECK_THROWS_AS(Histogram(Histogram::bins - 1, {1, 1}), std::invalid_argument);
}

TEST_CASE("quantiles are linear within a bin") {
  // Four values in the bin [1, 1 + 1/32): a quarter of the bin each.
  const Histogram histogram = histogram_of({1.0, 1.0, 1.0, 1.0});
  CHECK(histogram.quantile(0.0) == 1.0);
  CHECK(histogram.quantile(0.5) == 1.0 + 0.5 / 32);
  CHECK(histogram.quantile(1.0) == 1.0 + 1.0 / 32);
}

TEST_CASE("quantiles at the ends of the scale") {
  CHECK(std::isnan(Histogram{}.quantile(0.5)));
  CHECK(histogram_of({0.0, 0.0}).quantile(0.5) == 0.5 * std::ldexp(1.0, Histogram::lowest_octave));
  const Histogram half_failed = histogram_of({1.0, 2.0, infinity, infinity});
  CHECK(half_failed.quantile(0.5) == 2.0 + 2.0 / 32);
  CHECK(half_failed.quantile(0.51) == infinity);
}

TEST_CASE("quantiles of a sample are within a bin of the sorted values") {
  std::mt19937_64 engine(3);
  std::lognormal_distribution<double> distribution(0.0, 2.0);
  std::vector<double> values(10001);
  for (double& value : values) value = distribution(engine);
  const Histogram histogram = histogram_of(values);
  std::sort(values.begin(), values.end());
  for (const double q : {0.05, 0.25, 0.5, 0.75, 0.95}) {
    const double exact = values[static_cast<std::size_t>(q * 10001.0)];
    CHECK(std::abs(histogram.quantile(q) - exact) <= exact / Histogram::bins_per_octave);
  }
}

}  // namespace
