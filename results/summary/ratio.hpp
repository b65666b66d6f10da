#pragma once

#include "results/statistics/moments.hpp"
#include "results/statistics/statistics.hpp"
#include "results/summary/summary.hpp"

/// Ratios of means, with the error that belongs to means over common trials.
namespace ridgeloc::results {

/// A number with its standard error and 95 % interval.
struct Estimate {
  double value = 0.0;
  double error = 0.0;
  double lo = 0.0;
  double hi = 0.0;
};

/// R = a / b of two means with covariance c of the two. By the delta method
///
///   s(R)^2 = (s(a)^2 + R^2 s(b)^2 - 2 R c) / b^2,
///
/// s(a) and s(b) the standard errors; the interval is R exp(-+ t s(R) / R), and R -+ t s(R) where R is not positive,
/// with t of the smaller number of values less 1. NaN where either has fewer than two values or b is 0.
Estimate ratio_of_means(const Moments& a, const Moments& b, double covariance);

/// Covariance of two means over common trials, from what their difference trial by trial adds up to. With sums over the
/// n_d trials that both have,
///
///   2 sum (x - a)(y - b) = sum (x - a)^2 + sum (y - b)^2 - sum (x - y - (a - b))^2,
///
/// of which the last is known and the others are, but for trials that one of the two has alone (`error_m`: where the
/// other failed). These are counted with the largest deviation that their method has anywhere, so that what comes out
/// is at most the covariance, and at least 0, and the error of a ratio at least as long as it should be. Where both
/// have the same trials it is (s(a)^2 + s(b)^2 - s(a - b)^2) / 2. 0 if either has values beyond the limit of moments.
double covariance_of_means(const MetricStatistics& a, const MetricStatistics& b, const MetricStatistics& difference);

/// Whether the error of a ratio by `ratio_of_means` is reliable, given that those of the means are: that of the mean
/// below the line is at most a tenth of it, so that what the delta method leaves out is about a hundredth of the ratio.
bool is_ratio_linear(const Moments& below);

/// The summary with a method "a / b" behind each difference "a - b". Its rows (`summary_rows`) are the ratios of the
/// means of what the difference has, and have no other statistics.
Summary with_ratios(const Summary& summary);

}  // namespace ridgeloc::results
