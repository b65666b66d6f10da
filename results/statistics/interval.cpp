#include "results/statistics/interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ridgeloc::results {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double z = normal_quantile_975;

/// Mean of v^2 and its standard error.
struct MeanSquare {
  double value = nan;
  double error = nan;
};

MeanSquare mean_square(const Moments& moments) {
  if (moments.n == 0) return {};
  const double n = static_cast<double>(moments.n);
  const double mean = moments.mean;
  const double c2 = moments.m2 / n;
  const double value = mean * mean + c2;
  if (moments.n < 2) return {value, nan};
  // Var(v^2) = Var((v - mean)^2 + 2 mean (v - mean)), which cancels less than E v^4 - (E v^2)^2.
  const double variance = moments.m4 / n - c2 * c2 + 4.0 * mean * (moments.m3 / n + mean * c2);
  return {value, std::sqrt(std::max(variance, 0.0) / (n - 1.0))};
}

}  // namespace

double two_sided_quantile(double chance) {
  double low = 0.0;
  double high = 40.0;
  while (high - low > 1e-9) {
    const double middle = 0.5 * (low + high);
    (std::erfc(middle / std::sqrt(2.0)) > chance ? low : high) = middle;
  }
  return high;
}

double student_quantile(double normal, std::uint64_t degrees_of_freedom) {
  if (degrees_of_freedom == 0) return nan;
  const double square = normal * normal;
  const double g1 = normal * (square + 1.0) / 4.0;
  const double g2 = normal * ((5.0 * square + 16.0) * square + 3.0) / 96.0;
  const double g3 = normal * (((3.0 * square + 19.0) * square + 17.0) * square - 15.0) / 384.0;
  const double g4 =
      normal * ((((79.0 * square + 776.0) * square + 1482.0) * square - 1920.0) * square - 945.0) / 92160.0;
  const double w = 1.0 / static_cast<double>(degrees_of_freedom);
  return normal + w * (g1 + w * (g2 + w * (g3 + w * g4)));
}

double student_quantile_975(std::uint64_t degrees_of_freedom) {
  constexpr double confidence = 0.95;
  if (degrees_of_freedom == 1) return 12.706204736174698;  // tan(0.95 pi / 2)
  if (degrees_of_freedom == 2) return confidence * std::sqrt(2.0 / (1.0 - confidence * confidence));
  return student_quantile(z, degrees_of_freedom);
}

double standard_deviation(const Moments& moments) {
  if (moments.n < 2) return nan;
  return std::sqrt(moments.m2 / static_cast<double>(moments.n - 1));
}

double mean_standard_error(const Moments& moments) {
  return standard_deviation(moments) / std::sqrt(static_cast<double>(moments.n));
}

double standard_deviation_error(const Moments& moments) {
  return standard_deviation(moments) * std::sqrt(variance_of_variance(moments) / 4.0);
}

double variance_of_variance(const Moments& moments) {
  if (moments.m2 == 0.0) return 0.0;
  const double difference = moments.m4 / (moments.m2 * moments.m2) - 1.0 / static_cast<double>(moments.n);
  return std::max(difference, 0.0);  // zero in theory for two equal halves; rounding may put it below
}

Interval mean_interval(const Moments& moments) {
  if (moments.n < 2) return {nan, nan};
  const double half = student_quantile_975(moments.n - 1) * mean_standard_error(moments);
  return {moments.mean - half, moments.mean + half};
}

double root_mean_square(const Moments& moments) {
  return std::sqrt(mean_square(moments).value);
}

double root_mean_square_error(const Moments& moments) {
  const MeanSquare square = mean_square(moments);
  return square.value == 0.0 ? 0.0 : square.error / (2.0 * std::sqrt(square.value));
}

double largest_share_of_squares(const Moments& moments, double min, double max) {
  const MeanSquare square = mean_square(moments);
  if (square.error == 0.0) return 0.0;
  const double n = static_cast<double>(moments.n);
  const double sum = square.error * square.error * (n - 1.0) * n;
  const double largest = std::max(min * min, max * max);
  const double smallest = min > 0.0 || max < 0.0 ? std::min(min * min, max * max) : 0.0;
  const double deviation = std::max(largest - square.value, square.value - smallest);
  return deviation * deviation / sum;
}

Interval root_mean_square_interval(const Moments& moments) {
  const MeanSquare square = mean_square(moments);
  if (std::isnan(square.error)) return {nan, nan};
  if (square.value == 0.0) return {0.0, 0.0};
  const double half = student_quantile_975(moments.n - 1) * square.error / (2.0 * square.value);
  const double rms = std::sqrt(square.value);
  return {rms * std::exp(-half), rms * std::exp(half)};
}

Interval wilson_interval(std::uint64_t successes, std::uint64_t trials) {
  if (trials == 0) return {nan, nan};
  const double n = static_cast<double>(trials);
  const double k = static_cast<double>(successes);
  const double centre = (k + z * z / 2.0) / (n + z * z);
  const double half = z / (n + z * z) * std::sqrt(k * (n - k) / n + z * z / 4.0);
  // The two ends are exact in theory and would differ by rounding.
  return {successes == 0 ? 0.0 : centre - half, successes == trials ? 1.0 : centre + half};
}

double upper_bound_of_none(std::uint64_t trials) {
  if (trials == 0) return std::numeric_limits<double>::quiet_NaN();
  return std::min(3.0 / static_cast<double>(trials), 1.0);
}

Interval chi_square_mean_range(std::uint64_t n, std::uint64_t degrees_of_freedom) {
  if (n == 0) return {nan, nan};
  const double freedom = static_cast<double>(degrees_of_freedom);
  const double spread = 2.0 / (9.0 * static_cast<double>(n) * freedom);
  const auto at = [&](double quantile) { return freedom * std::pow(1.0 - spread + quantile * std::sqrt(spread), 3); };
  return {at(-z), at(z)};
}

Interval quantile_interval(const Histogram& histogram, double q, const Histogram::Range& range) {
  const double n = static_cast<double>(histogram.total());
  if (n * std::min(q, 1.0 - q) < 3.0) return {nan, nan};
  const double half = z * std::sqrt(n * q * (1.0 - q));
  const double low_rank = std::max(std::floor(n * q - half), 1.0);
  const double high_rank = std::min(std::ceil(n * q + half) + 1.0, n);
  // The order statistic of rank r holds the share ((r - 1) / n, r / n] of the sample: its outer end is taken.
  return {histogram.quantile((low_rank - 1.0) / n, range), histogram.quantile(high_rank / n, range)};
}

}  // namespace ridgeloc::results
