#include "results/statistics/interval.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/catch.hpp"

namespace {

using namespace ridgeloc::results;

TEST_CASE("Student's t quantile agrees with printed tables to its stated error") {
  struct Row {
    std::uint64_t degrees_of_freedom;
    double table;  // Abramowitz and Stegun, table 26.10, and longer tables
    double error;  // relative, as documented; half a unit of the table's last digit where that is larger
  };
  const Row rows[] = {{1, 12.7062047, 1e-8}, {2, 4.30265273, 1e-8},  {3, 3.18244631, 1.3e-3}, {4, 2.77644511, 1.3e-3},
                      {9, 2.26215716, 7e-6}, {21, 2.07961384, 1e-7}, {60, 2.00029782, 1e-7},  {199, 1.97195654, 1e-7}};
  for (const Row& row : rows) {
    INFO("degrees of freedom: " << row.degrees_of_freedom);
    CHECK(std::abs(student_quantile_975(row.degrees_of_freedom) / row.table - 1.0) <= row.error);
  }
  CHECK(std::isnan(student_quantile_975(0)));
  CHECK(student_quantile_975(1'000'000'000'000) == Approx(normal_quantile_975));
}

TEST_CASE("interval of a mean worked by hand") {
  // 1..10: mean 5.5, M2 = 82.5, s^2 = 55 / 6, standard error sqrt(11 / 12), t(9) = 2.262157.
  std::vector<double> values(10);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i + 1);
  const Moments moments = moments_of(values);
  CHECK(standard_deviation(moments) == Approx(std::sqrt(55.0 / 6.0)));
  CHECK(mean_standard_error(moments) == Approx(std::sqrt(11.0 / 12.0)));
  const Interval interval = mean_interval(moments);
  CHECK(interval.lo == Approx(3.334149).margin(2e-5));
  CHECK(interval.hi == Approx(7.665851).margin(2e-5));
}

TEST_CASE("one value has no standard error") {
  const Moments moments = moments_of(std::vector{2.0});
  CHECK(std::isnan(mean_standard_error(moments)));
  CHECK(std::isnan(standard_deviation_error(moments)));
  CHECK(std::isnan(mean_interval(moments).lo));
}

TEST_CASE("variance of the variance and error of the standard deviation worked by hand") {
  // -2, -1, 0, 1, 2: M2 = 10, M4 = 34, kurtosis 5 * 34 / 100 = 1.7, s = sqrt(2.5).
  const Moments moments = moments_of(std::vector{-2.0, -1.0, 0.0, 1.0, 2.0});
  CHECK(variance_of_variance(moments) == Approx(0.34 - 0.2));
  CHECK(standard_deviation_error(moments) == Approx(std::sqrt(2.5) * std::sqrt(0.7 / 20.0)));
}

TEST_CASE("a sample without spread has no error") {
  const Moments moments = moments_of(std::vector{3.0, 3.0, 3.0});
  CHECK(variance_of_variance(moments) == 0.0);
  CHECK(standard_deviation_error(moments) == 0.0);
  CHECK(mean_interval(moments).lo == 3.0);
  CHECK(mean_interval(moments).hi == 3.0);
}

TEST_CASE("Wilson's interval: published examples") {
  // Newcombe, Statistics in Medicine 17 (1998), table I, method 3.
  const auto check = [](std::uint64_t successes, std::uint64_t trials, double lo, double hi) {
    const Interval interval = wilson_interval(successes, trials);
    CHECK(interval.lo == Approx(lo).margin(5e-5));
    CHECK(interval.hi == Approx(hi).margin(5e-5));
  };
  check(81, 263, 0.2553, 0.3662);
  check(15, 148, 0.0624, 0.1605);
  check(0, 20, 0.0, 0.1611);
  check(1, 29, 0.0061, 0.1718);
}

TEST_CASE("Wilson's interval is exact at the ends and mirrors successes into failures") {
  CHECK(wilson_interval(0, 7).lo == 0.0);
  CHECK(wilson_interval(7, 7).hi == 1.0);
  for (std::uint64_t k = 0; k <= 7; ++k) {
    CHECK(wilson_interval(k, 7).lo == Approx(1.0 - wilson_interval(7 - k, 7).hi).margin(1e-15));
  }
  CHECK(std::isnan(wilson_interval(0, 0).lo));
}

TEST_CASE("quantile interval: ranks worked by hand") {
  // n = 64, q = 1/2: 32 -+ 7.84, so the ranks are 24 and 41. Each integer 1..64 has a bin that begins at it;
  // the interval begins where the 23rd value's share ends and ends where the 41st value's ends.
  std::vector<double> values(64);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i + 1);
  Histogram histogram;
  histogram.add(values);
  const Interval interval = quantile_interval(histogram, 0.5);
  CHECK(interval.lo == histogram.quantile(23.0 / 64.0));
  CHECK(interval.lo >= 23.0);
  CHECK(interval.lo <= 24.0);
  CHECK(interval.hi == histogram.quantile(41.0 / 64.0));
  CHECK(interval.hi >= 41.0);
  CHECK(interval.hi <= 42.0);
}

TEST_CASE("quantile interval of a small sample ends with the sample, and is infinite where trials failed") {
  Histogram histogram;
  histogram.add(std::vector{1.0, 2.0, 3.0, 4.0, 5.0, std::numeric_limits<double>::infinity()});
  const Interval interval = quantile_interval(histogram, 0.5);
  CHECK(interval.lo == 1.0);
  CHECK(interval.hi == std::numeric_limits<double>::infinity());
  CHECK(std::isnan(quantile_interval(Histogram{}, 0.5).lo));
}

TEST_CASE("there is no quantile interval where all of the sample would cover less than 95 %") {
  // All n values lie on one side of the quantile with a chance of q^n: 0.5^5 = 3.1 % twice, and 0.95^59 = 4.8 %.
  const auto is_known = [](int n, double q) {
    Histogram histogram;
    for (int i = 1; i <= n; ++i) histogram.add(std::vector{static_cast<double>(i)});
    const Interval interval = quantile_interval(histogram, q);
    CHECK(std::isnan(interval.lo) == std::isnan(interval.hi));
    return !std::isnan(interval.lo);
  };
  CHECK_FALSE(is_known(5, 0.5));
  CHECK(is_known(6, 0.5));
  CHECK_FALSE(is_known(59, 0.95));
  CHECK(is_known(60, 0.95));
  CHECK_FALSE(is_known(59, 0.05));
}

}  // namespace

TEST_CASE("the root mean square and its error are those of the squares themselves") {
  const std::vector<double> values = {-3.0, 0.5, 1.0, 2.5, 7.0, 7.5, -0.25, 4.0};
  std::vector<double> squares;
  for (const double v : values) squares.push_back(v * v);
  const Moments moments = moments_of(values);
  const Moments square = moments_of(squares);
  const double rms = std::sqrt(square.mean);
  CHECK(root_mean_square(moments) == Approx(rms).epsilon(1e-14));
  CHECK(root_mean_square_error(moments) == Approx(mean_standard_error(square) / (2.0 * rms)).epsilon(1e-13));
  const Interval interval = root_mean_square_interval(moments);
  const double half = student_quantile_975(values.size() - 1) * mean_standard_error(square) / (2.0 * square.mean);
  CHECK(interval.lo == Approx(rms * std::exp(-half)).epsilon(1e-13));
  CHECK(interval.hi == Approx(rms * std::exp(half)).epsilon(1e-13));
  CHECK(root_mean_square_error(moments_of(std::vector<double>{0.0, 0.0})) == 0.0);
  CHECK(std::isnan(root_mean_square(Moments{})));
  CHECK(std::isnan(root_mean_square_interval(moments_of(std::vector<double>{1.0})).lo));
}

TEST_CASE("the largest share of squares is that of the value furthest from the mean square") {
  for (const std::vector<double>& values :
       {std::vector<double>{0.5, 1.0, 2.5, 7.0, 7.5, 4.0}, {5.0, 5.5, 6.0, 1.0, 5.0}, {-3.0, 0.0, 1.0, 2.0}}) {
    const double mean_square = std::pow(root_mean_square(moments_of(values)), 2);
    double largest = 0.0;
    double sum = 0.0;
    for (const double v : values) {
      const double deviation = std::pow(v * v - mean_square, 2);
      largest = std::max(largest, deviation);
      sum += deviation;
    }
    const auto [min, max] = std::minmax_element(values.begin(), values.end());
    CHECK(largest_share_of_squares(moments_of(values), *min, *max) == Approx(largest / sum).epsilon(1e-12));
  }
  CHECK(largest_share_of_squares(moments_of(std::vector<double>{2.0, 2.0}), 2.0, 2.0) == 0.0);
  CHECK(std::isnan(largest_share_of_squares(moments_of(std::vector<double>{2.0}), 2.0, 2.0)));
}

TEST_CASE("the range of chi-square means is that of tables") {
  // 2.5 % and 97.5 % quantiles with 30, 300 and 3000 degrees of freedom.
  const struct {
    std::uint64_t n;
    double low, high;
  } rows[] = {{10, 16.791, 46.979}, {100, 253.912, 349.874}, {1000, 2850.122, 3153.625}};
  for (const auto& [n, low, high] : rows) {
    const Interval range = chi_square_mean_range(n, 3);
    CHECK(range.lo * static_cast<double>(n) == Approx(low).epsilon(1e-3));
    CHECK(range.hi * static_cast<double>(n) == Approx(high).epsilon(1e-3));
  }
  CHECK(std::isnan(chi_square_mean_range(0, 3).lo));
}
