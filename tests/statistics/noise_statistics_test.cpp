// Statistical tests of the noise models and the scores. Each states its false-alarm rate under the hypothesis that the
// numbers are what they claim to be; since streams are fixed, a test that passes once always passes.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/noise_draw.hpp"

using namespace ridgeloc;
using tests::draw_errors;
using tests::noise_options;

namespace {

/// Two-sided false-alarm rate of |z| > 4.5: 7e-6.
constexpr double z_limit = 4.5;

template <class F>
double mean_of(const std::vector<double>& values, F&& f) {
  double sum = 0.0;
  for (const double value : values) sum += f(value);
  return sum / static_cast<double>(values.size());
}

/// How many standard errors the mean of f lies from `expected`; `square` is the expectation of f^2.
template <class F>
double mean_z(const std::vector<double>& values, F&& f, double expected, double square) {
  const double variance = square - expected * expected;
  return (mean_of(values, f) - expected) / std::sqrt(variance / static_cast<double>(values.size()));
}

/// How many standard errors the share of values above `limit` in size lies from `expected`.
double tail_z(const std::vector<double>& values, double limit, double expected) {
  return mean_z(
      values, [&](double v) { return std::fabs(v) > limit ? 1.0 : 0.0; }, expected, expected);
}

/// How many standard errors the correlation of f(a, trial) and f(b, trial) lies from zero.
template <class F>
double correlation_z(std::size_t trials, F&& f, std::size_t a, std::size_t b) {
  double sum_a = 0.0, sum_b = 0.0, squares_a = 0.0, squares_b = 0.0, products = 0.0;
  for (std::size_t t = 0; t < trials; ++t) {
    const double x = f(a, t);
    const double y = f(b, t);
    sum_a += x;
    sum_b += y;
    squares_a += x * x;
    squares_b += y * y;
    products += x * y;
  }
  const auto n = static_cast<double>(trials);
  const double covariance = products / n - sum_a / n * (sum_b / n);
  const double variances = (squares_a / n - sum_a / n * (sum_a / n)) * (squares_b / n - sum_b / n * (sum_b / n));
  return covariance / std::sqrt(variances) * std::sqrt(n);
}

/// P(|t| > q) of Student's t distribution: 1 less the integral of its density from -q to q by Simpson's rule.
double student_tail(double dof, double q) {
  const double log_norm =
      std::lgamma((dof + 1.0) / 2.0) - std::lgamma(dof / 2.0) - 0.5 * std::log(dof * std::numbers::pi);
  const auto density = [&](double t) { return std::exp(log_norm - (dof + 1.0) / 2.0 * std::log1p(t * t / dof)); };
  constexpr int intervals = 2000;
  const double h = q / intervals;
  double sum = density(0.0) + density(q);
  for (int i = 1; i < intervals; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * density(i * h);
  return 1.0 - 2.0 * sum * h / 3.0;
}

/// E s^p for s uniform on [low, 1].
double score_moment(double low, double p) {
  return p == -1.0 ? -std::log(low) / (1.0 - low) : (1.0 - std::pow(low, p + 1.0)) / ((p + 1.0) * (1.0 - low));
}

}  // namespace

TEST_CASE("Student errors with 3 degrees of freedom follow their distribution out into the tails") {
  auto options = noise_options();
  options.dof = 3.0;
  auto values = draw_errors("student_t", options);
  std::ranges::sort(values);
  // Scaled to standard deviation 1, z = t / sqrt 3: F(z) = 1/2 + (z / (1 + z^2) + atan z) / pi. Kolmogorov-Smirnov:
  // P(sqrt(n) D > 2.4) = 2 exp(-2 * 2.4^2) = 2e-5.
  const auto n = static_cast<double>(values.size());
  double distance = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double z = values[i];
    const double cdf = 0.5 + (z / (1.0 + z * z) + std::atan(z)) / std::numbers::pi;
    const auto rank = static_cast<double>(i);
    distance = std::max({distance, std::fabs(cdf - rank / n), std::fabs(cdf - (rank + 1.0) / n)});
  }
  CHECK(distance * std::sqrt(n) < 2.4);
  for (const double q : {2.0, 5.0, 10.0}) {
    const double tail = 1.0 - 2.0 / std::numbers::pi * (q / (1.0 + q * q) + std::atan(q));
    CHECK(std::fabs(tail_z(values, q, tail)) < z_limit);
  }
}

TEST_CASE("Student errors with other degrees of freedom, whole or not, have its tails and variance") {
  auto options = noise_options();
  for (const double dof : {2.1, 2.5, 7.3, 40.0, 1000.0}) {
    INFO("dof " << dof);
    options.dof = dof;
    const auto values = draw_errors("student_t", options);
    const double scale = std::sqrt((dof - 2.0) / dof);
    for (const double q : {0.5, 1.0, 2.0, 3.0}) {
      CHECK(std::fabs(tail_z(values, q * scale, student_tail(dof, q))) < z_limit);
    }
    if (dof < 30.0) continue;  // the variance of the variance is not finite, or not yet normal
    const double fourth = 3.0 * (dof - 2.0) / (dof - 4.0);
    CHECK(std::fabs(mean_z(
              values, [](double z) { return z; }, 0.0, 1.0)) < z_limit);
    CHECK(std::fabs(mean_z(
              values, [](double z) { return z * z; }, 1.0, fourth)) < z_limit);
  }
}

TEST_CASE("every noise model: errors of a trial's points are independent in sign and size") {
  for (const sim::NoiseEntry& entry : sim::noise_registry()) {
    // At a range of 0 errors proportional to it would vanish.
    const double range_m = entry.name == "proportional" ? 5.0 : 0.0;
    const auto p = tests::draw_ranges(entry.name, noise_options(), {7, 50'000, 0, false, range_m});
    // The median size of a normal; what share of the errors lies beyond it does not matter.
    const auto positive = [&](std::size_t j, std::size_t t) { return p.measured(j)[t] > range_m; };
    const auto large = [&](std::size_t j, std::size_t t) { return std::fabs(p.measured(j)[t] - range_m) > 0.6745; };
    for (std::size_t a = 0; a < p.points(); ++a) {
      for (std::size_t b = a + 1; b < p.points(); ++b) {
        INFO(entry.name << ", points " << a << " and " << b);
        CHECK(std::fabs(correlation_z(p.trials(), positive, a, b)) < z_limit);
        CHECK(std::fabs(correlation_z(p.trials(), large, a, b)) < z_limit);
      }
    }
  }
}

TEST_CASE("outliers come at their rate and size, whatever the error and the neighbour") {
  auto options = noise_options();
  options.outlier_rate = 0.0;
  const auto base = draw_errors("contaminated", options);
  for (const double rate : {0.02, 0.1, 0.5}) {
    INFO("rate " << rate);
    options.outlier_rate = rate;
    options.outlier_size = 20.0;
    const auto values = draw_errors("contaminated", options);
    double count = 0.0, by_size = 0.0, pairs = 0.0;
    const std::size_t trials = tests::Draw{}.trials;
    const auto excess = [&](std::size_t i) { return (values[i] != base[i] ? 1.0 : 0.0) - rate; };
    for (std::size_t i = 0; i < values.size(); ++i) {
      count += excess(i);
      by_size += excess(i) * (std::fabs(base[i]) > 0.6744897501960817 ? 1.0 : -1.0);
      if (i < 6 * trials) pairs += excess(i) * excess(i + trials);  // the same trial, the next point
    }
    const double variance = rate * (1.0 - rate);
    const auto n = static_cast<double>(values.size());
    CHECK(std::fabs(count) < z_limit * std::sqrt(n * variance));
    CHECK(std::fabs(by_size) < z_limit * std::sqrt(n * variance));
    CHECK(std::fabs(pairs) < z_limit * std::sqrt(n * 6.0 / 7.0) * variance);
    // E z^2 = 1 + rate (size^2 - 1), E z^4 = 3 (1 + rate (size^4 - 1)).
    const double second = 1.0 + rate * 399.0;
    CHECK(std::fabs(mean_z(
              values, [](double z) { return z * z; }, second, 3.0 * (1.0 + rate * 159'999.0))) < z_limit);
  }
}

TEST_CASE("proportional errors are normal with a standard deviation of range over reference") {
  auto options = noise_options();
  options.reference_depth_m = 5.0;
  for (const double range_m : {1.0, 5.0, 12.0}) {
    auto values = draw_errors("proportional", options, {7, 50'000, 0, false, range_m});
    for (double& value : values) value = (value - range_m) / (range_m / 5.0);
    CHECK(std::fabs(mean_z(
              values, [](double z) { return z; }, 0.0, 1.0)) < z_limit);
    CHECK(std::fabs(mean_z(
              values, [](double z) { return z * z; }, 1.0, 3.0)) < z_limit);
  }
}

TEST_CASE("empirical errors take every sample equally often, also in pairs, and have the level asked for") {
  const auto options = noise_options(0.5);
  const auto p = tests::draw_ranges("empirical", options, {});
  constexpr std::size_t samples = tests::noise_samples.size();
  std::vector<double> single(samples), pair(samples * samples);
  double squares = 0.0;
  const auto index = [&](std::size_t j, std::size_t t) {
    const auto nearest = std::ranges::min_element(tests::noise_samples, {}, [&](double s) {
      return std::fabs(p.measured(j)[t] - 0.5 * s / options.samples_rms);
    });
    return static_cast<std::size_t>(nearest - tests::noise_samples.begin());
  };
  for (std::size_t t = 0; t < p.trials(); ++t) {
    for (std::size_t j = 0; j < p.points(); ++j) {
      single[index(j, t)] += 1.0;
      squares += p.measured(j)[t] * p.measured(j)[t];
    }
    pair[index(0, t) * samples + index(1, t)] += 1.0;
  }
  const auto chi_square = [](const std::vector<double>& counts) {
    double total = 0.0, sum = 0.0;
    for (const double count : counts) total += count;
    const double expected = total / static_cast<double>(counts.size());
    for (const double count : counts) sum += (count - expected) * (count - expected) / expected;
    return sum;
  };
  // P(chi^2 > 33.4) = 1e-6 with 4 degrees of freedom; P(chi^2 > 73.9) = 5e-7 with 24.
  CHECK(chi_square(single) < 33.4);
  CHECK(chi_square(pair) < 73.9);
  // Fourth powers: (16 + 1/256 + 1/16 + 1 + 81) / 5 over the square of 14.3125 / 5.
  const double fourth = (16.0 + 1.0 / 256.0 + 1.0 / 16.0 + 82.0) / 5.0 / std::pow(14.3125 / 5.0, 2);
  const auto n = static_cast<double>(p.points() * p.trials());
  CHECK(std::fabs(squares / 0.25 / n - 1.0) < z_limit * std::sqrt((fourth - 1.0) / n));
}

TEST_CASE("scores of a trial's points are independent") {
  const auto p = tests::draw_ranges("normal", noise_options(), {7, 50'000, 0, true});
  for (std::size_t a = 0; a < p.points(); ++a) {
    for (std::size_t b = a + 1; b < p.points(); ++b) {
      INFO("points " << a << " and " << b);
      const auto score = [&](std::size_t j, std::size_t t) { return p.score(j)[t]; };
      CHECK(std::fabs(correlation_z(p.trials(), score, a, b)) < z_limit);
    }
  }
}

TEST_CASE("scores are uniform, and errors keep their root mean square whatever scores say") {
  for (const double exponent : {-3.0, -1.0, -0.5, 0.0, 1.0, 2.5}) {
    auto options = noise_options();
    options.score = {0.2, exponent};
    const auto p = tests::draw_ranges("normal", options, {7, 50'000, 0, true});
    std::vector<double> scores, errors, products;
    for (std::size_t t = 0; t < p.trials(); ++t) {
      for (std::size_t j = 0; j < p.points(); ++j) {
        scores.push_back(p.score(j)[t]);
        errors.push_back(p.measured(j)[t]);
        products.push_back(p.score(j)[t] * std::fabs(p.measured(j)[t]));
      }
    }
    const auto moment = [](double power) { return score_moment(0.2, power); };
    const auto same = [](double v) { return v; };
    const auto square = [](double v) { return v * v; };
    CHECK(std::fabs(mean_z(scores, same, moment(1), moment(2))) < z_limit);
    CHECK(std::fabs(mean_z(scores, square, moment(2), moment(4))) < z_limit);
    const double score_variance = moment(2) - moment(1) * moment(1);

    const double c = exponent;
    CHECK(std::fabs(mean_z(errors, same, 0.0, 1.0)) < z_limit);
    CHECK(std::fabs(mean_z(errors, square, 1.0, 3.0 * moment(4 * c) / (moment(2 * c) * moment(2 * c)))) < z_limit);
    // E s |e| = sqrt(2 / pi) E s^(c+1) / sqrt(E s^2c), E s^2 e^2 = E s^(2c+2) / E s^2c.
    const double mean_size = std::sqrt(2.0 / std::numbers::pi) / std::sqrt(moment(2 * c));
    const double product = mean_size * moment(c + 1);
    CHECK(std::fabs(mean_z(products, same, product, moment(2 * c + 2) / moment(2 * c))) < z_limit);

    // The correlation of score and size of error that follows, as docs/studies.md states it.
    const double measured_size = mean_of(errors, [](double e) { return std::fabs(e); });
    const double correlation = (mean_of(products, same) - mean_of(scores, same) * measured_size) /
                               std::sqrt(score_variance * (mean_of(errors, square) - measured_size * measured_size));
    const double size_variance = 1.0 - mean_size * mean_size * moment(c) * moment(c);
    const double expected = (product - moment(1) * mean_size * moment(c)) / std::sqrt(score_variance * size_variance);
    INFO("c = " << c << ": correlation " << correlation << ", expected " << expected);
    CHECK(correlation == Approx(expected).margin(0.01));
  }
}
