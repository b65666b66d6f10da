#include "results/statistics/histogram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"

namespace {

using namespace ridgeloc::results;
using ridgeloc::tests::infinity;
using ridgeloc::tests::not_a_number;

constexpr double largest = std::numeric_limits<double>::max();

Histogram histogram_of(const std::vector<double>& values) {
  Histogram histogram;
  histogram.add(values);
  return histogram;
}

TEST_CASE("each bin begins at its lower edge and ends before the next") {
  for (std::uint32_t bin = 1; bin <= Histogram::infinite_bin; ++bin) {
    const double edge = Histogram::lower_edge(bin);
    REQUIRE(Histogram::bin_of(edge) == bin);
    REQUIRE(Histogram::bin_of(std::nextafter(edge, 0.0)) == bin - 1);
  }
  CHECK(Histogram::lower_edge(0) == 0.0);
  CHECK(Histogram::lower_edge(1) == std::ldexp(1.0, -1027));
  CHECK(Histogram::lower_edge(Histogram::infinite_bin) == infinity);
  CHECK(Histogram::lower_edge(Histogram::infinite_bin + 1) == infinity);
}

TEST_CASE("zero, negative and infinite values fall into the end bins, all others between") {
  for (const double small : {0.0, -0.0, 5e-324, -1.0, -infinity}) CHECK(Histogram::bin_of(small) == 0);
  CHECK(Histogram::bin_of(infinity) == Histogram::infinite_bin);
  for (const double inner : {std::numeric_limits<double>::min(), 1e-13, 1.0, 1.6e12, largest}) {
    CHECK(Histogram::bin_of(inner) > 0);
    CHECK(Histogram::bin_of(inner) < Histogram::infinite_bin);
  }
}

TEST_CASE("adding counts every value in its bin, whatever lies beside it") {
  std::mt19937_64 engine(5);
  std::uniform_real_distribution<double> decades(-300.0, 300.0);
  const std::vector<double> ends = {0.0, -1.0, 5e-324, infinity, -infinity, largest, not_a_number, -not_a_number};
  for (const std::size_t with : {std::size_t{0}, std::size_t{3}, ends.size()}) {
    std::vector<double> values(ends.begin(), ends.begin() + static_cast<std::ptrdiff_t>(with));
    for (int i = 0; i < 3001; ++i) values.push_back(std::pow(10.0, decades(engine)));
    std::map<std::uint32_t, std::uint64_t> expected;
    for (const double value : values) {
      if (!std::isnan(value)) ++expected[Histogram::bin_of(value)];
    }
    const Histogram histogram = histogram_of(values);
    REQUIRE(histogram.bins().size() == expected.size());
    for (const auto& [bin, count] : expected) REQUIRE(histogram.count_in(bin) == count);
    CHECK(histogram.count_in(Histogram::bin_of(largest) - 1) == 0);
  }
}

TEST_CASE("the integers 1 to 64 have bins of their own") {
  std::set<std::uint32_t> bins;
  for (int i = 1; i <= 64; ++i) bins.insert(Histogram::bin_of(i));
  CHECK(bins.size() == 64);
}

TEST_CASE("NaN is not counted, of either sign") {
  CHECK(histogram_of({not_a_number, -not_a_number}) == Histogram{});
  CHECK(histogram_of({1.0, not_a_number, infinity, -not_a_number}).total() == 2);
}

TEST_CASE("only bins in use are kept") {
  const Histogram histogram = histogram_of({4.0, 1e300, 4.0, 0.0});
  REQUIRE(histogram.bins().size() == 3);
  CHECK(histogram.bins()[0] == Histogram::Bin{0, 1});
  CHECK(histogram.bins()[1] == Histogram::Bin{Histogram::bin_of(4.0), 2});
  CHECK(histogram.bins()[2] == Histogram::Bin{Histogram::bin_of(1e300), 1});
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

TEST_CASE("a histogram is what its bins say, and refuses bins that cannot be") {
  const Histogram made = histogram_of({3.0, 3.1, 9.0});
  CHECK(Histogram(made.bins()) == made);
  using Bins = std::vector<Histogram::Bin>;
  CHECK_NOTHROW(Histogram(Bins{{0, 1}, {Histogram::infinite_bin, 1}}));
  CHECK_THROWS_AS(Histogram(Bins{{Histogram::infinite_bin + 1, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(Histogram(Bins{{7, 1}, {7, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(Histogram(Bins{{8, 1}, {7, 1}}), std::invalid_argument);
  CHECK_THROWS_AS(Histogram(Bins{{7, 0}}), std::invalid_argument);
}

TEST_CASE("quantiles are linear within a bin") {
  // Four values in the bin [1, 1 + 1/32): a quarter of the bin each.
  const Histogram histogram = histogram_of({1.0, 1.0, 1.0, 1.0});
  CHECK(histogram.quantile(0.0) == 1.0);
  CHECK(histogram.quantile(0.5) == 1.0 + 0.5 / 32);
  CHECK(histogram.quantile(1.0) == 1.0 + 1.0 / 32);
}

TEST_CASE("the bins at the ends of a sample reach to its extremes alone, where these are given") {
  const Histogram histogram = histogram_of({1.01, 1.01, 2.0, 2.0, 4.1, 4.1});
  CHECK(histogram.quantile(0.0, {1.01, 4.1}) == 1.01);
  CHECK(histogram.quantile(0.5, {1.01, 4.1}) == histogram.quantile(0.5));
  CHECK(histogram.quantile(1.0, {1.01, 4.1}) == 4.1);
  CHECK(histogram.quantile(5.0 / 6.0, {1.01, 4.1}) == Approx(4.05));
}

TEST_CASE("quantiles at the ends of the scale") {
  CHECK(std::isnan(Histogram{}.quantile(0.5)));
  CHECK(histogram_of({0.0, 0.0}).quantile(0.5) == 0.5 * std::ldexp(1.0, -1027));
  CHECK(histogram_of({largest}).quantile(0.0) == Histogram::lower_edge(Histogram::infinite_bin - 1));
  CHECK(histogram_of({largest}).quantile(1.0) == largest);
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

TEST_CASE("quantiles of squares are the squares of quantiles, however large and small") {
  // A bin is 1/32 of its value wide at most, so each is right to that much, and a square to twice as much.
  std::mt19937_64 engine(4);
  std::lognormal_distribution<double> distribution(0.0, 12.0);
  std::vector<double> values(10001), squares;
  for (double& value : values) value = distribution(engine);
  for (const double value : values) squares.push_back(value * value);
  const Histogram of_values = histogram_of(values);
  const Histogram of_squares = histogram_of(squares);
  REQUIRE(of_squares.quantile(0.01) < 1e-20);
  REQUIRE(of_squares.quantile(0.99) > 1e20);
  for (const double q : {0.001, 0.01, 0.05, 0.5, 0.95, 0.99, 0.999}) {
    const double square = std::pow(of_values.quantile(q), 2);
    INFO("q = " << q);
    CHECK(std::abs(of_squares.quantile(q) - square) <= square * 3.1 / Histogram::bins_per_octave);
  }
}

}  // namespace
