#pragma once

#include <cstdint>

#include "results/statistics/histogram.hpp"
#include "results/statistics/moments.hpp"

namespace ridgeloc::results {

/// A two-sided 95 % confidence interval.
struct Interval {
  double lo = 0.0;
  double hi = 0.0;
};

/// 0.975 quantile of the standard normal distribution.
inline constexpr double normal_quantile_975 = 1.959963984540054;

/// 0.975 quantile of Student's t distribution. Exact for 1 and 2 degrees of freedom; above, the expansion in
/// inverse powers of the degrees of freedom to the fourth (Abramowitz and Stegun 26.7.5), low by at
/// most 1.3e-3 of its value at 3, 7e-6 at 9 and 1e-7 from 21 on. NaN without a degree of freedom.
double student_quantile_975(std::uint64_t degrees_of_freedom);

/// Where the chance that a standard normal value is larger in size, erfc(z / sqrt 2), is `chance`.
double two_sided_quantile(double chance);

/// The quantile of Student's t distribution where the normal one is `z`, by the same expansion.
double student_quantile(double z, std::uint64_t degrees_of_freedom);

/// Sample standard deviation sqrt(M2 / (n - 1)); NaN for n < 2.
double standard_deviation(const Moments& moments);

/// Monte Carlo standard error of the mean, s / sqrt(n); NaN for n < 2.
double mean_standard_error(const Moments& moments);

/// Monte Carlo standard error of the sample standard deviation s: s sqrt((k - 1) / (4 n)) with the kurtosis
/// k = n M4 / M2^2. Holds for any distribution with a fourth moment; the normal-theory form s / sqrt(2 (n -
/// 1)) is several times too small for heavy tails. 0 for a sample without spread, NaN for n < 2.
double standard_deviation_error(const Moments& moments);

/// Relative variance of the sample variance, M4 / M2^2 - 1 / n = (k - 1) / n; 0 for a sample without spread.
/// Above 0.1 the standard errors are themselves uncertain by more than 16 %.
double variance_of_variance(const Moments& moments);

/// mean +- t s / sqrt(n), t of n - 1 degrees of freedom (which tends to the normal quantile); NaN for n < 2.
Interval mean_interval(const Moments& moments);

/// sqrt(sum v^2 / n), of errors the RMSE; NaN without values.
double root_mean_square(const Moments& moments);

/// Monte Carlo standard error of the root mean square R: s(v^2) / (2 R sqrt(n)), with the variance of v^2 from the
/// first four moments, so that it holds for any distribution with a fourth moment. 0 where all v are 0, NaN for n < 2.
double root_mean_square_error(const Moments& moments);

/// The largest share that one value has in the sum of (v^2 - R^2)^2 on which that error rests, of a sample from `min`
/// to `max`. Above some tenths the error is the work of one value. 0 without spread; NaN for n < 2.
double largest_share_of_squares(const Moments& moments, double min, double max);

/// R exp(-+ t s(R) / R), t of n - 1 degrees of freedom: symmetric in the logarithm, since the mean of v^2 is skewed.
Interval root_mean_square_interval(const Moments& moments);

/// Interval of a probability after `successes` of `trials` (Wilson 1927); NaN for no trials.
Interval wilson_interval(std::uint64_t successes, std::uint64_t trials);

/// One-sided 95 % upper bound of the probability of what has not happened in `trials` trials: 3 / n (the rule of three,
/// -log 0.05 rounded up), at most 1; NaN for no trials.
double upper_bound_of_none(std::uint64_t trials);

/// Where the mean of n independent values of a chi-square distribution with so many degrees of freedom lies with 95 %,
/// by Wilson and Hilferty's cube, to 1e-3 of itself where n times the degrees of freedom is at least 30; NaN without
/// values.
Interval chi_square_mean_range(std::uint64_t n, std::uint64_t degrees_of_freedom);

/// Interval of the q quantile between the order statistics of rank n q -+ z sqrt(n q (1 - q)), rounded outwards to
/// whole ranks and read from the histogram (linear within a bin, like `Histogram::quantile`). Where a rank lies outside
/// the sample, the end of the histogram stands for it; NaN where that would cover less than 95 %, since fewer than 3
/// values are to be expected beyond the quantile (the rule of three): n min(q, 1 - q) < 3.
Interval quantile_interval(const Histogram& histogram, double q, const Histogram::Range& range = {});

}  // namespace ridgeloc::results
