// Statistical tests of the random numbers. Each states its false-alarm rate under the hypothesis that the numbers are
// what they claim to be; since streams are fixed, a test that passes once always passes.

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/random.hpp"
#include "core/stream.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::core;

namespace {

constexpr std::size_t pairs = 500'000;
constexpr double samples = 2.0 * pairs;

/// Two-sided false-alarm rate of |z| > 4.5: 7e-6.
constexpr double z_limit = 4.5;

std::vector<double> normals(const Stream& stream) {
  std::vector<double> values;
  values.reserve(2 * pairs);
  for (std::size_t trial = 0; trial < pairs; ++trial) {
    const auto z = normal_pair(uniform_pair(stream.block(trial, 0)));
    values.insert(values.end(), z.begin(), z.end());
  }
  return values;
}

double correlation_z(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) sum += a[i] * b[i];
  return sum / std::sqrt(static_cast<double>(std::min(a.size(), b.size())));
}

double normal_cdf(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

}  // namespace

TEST_CASE("normals have the moments of a standard normal") {
  const auto values = normals(Stream(2018, "noise"));
  std::array<double, 5> moment{};
  for (const double z : values) {
    double power = 1.0;
    for (std::size_t k = 1; k <= 4; ++k) moment[k] += power *= z;
  }
  for (double& m : moment) m /= samples;
  // Standard errors of the raw moments: sqrt((E z^2k - (E z^k)^2) / n).
  CHECK(std::fabs(moment[1]) * std::sqrt(samples / 1.0) < z_limit);
  CHECK(std::fabs(moment[2] - 1.0) * std::sqrt(samples / 2.0) < z_limit);
  CHECK(std::fabs(moment[3]) * std::sqrt(samples / 15.0) < z_limit);
  CHECK(std::fabs(moment[4] - 3.0) * std::sqrt(samples / 96.0) < z_limit);
}

TEST_CASE("normals follow the normal distribution out into the tails") {
  auto values = normals(Stream(7, "noise"));
  std::sort(values.begin(), values.end());
  // Kolmogorov-Smirnov: P(sqrt(n) D > 2.4) = 2 exp(-2 * 2.4^2) = 2e-5.
  double distance = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double cdf = normal_cdf(values[i]);
    distance = std::max({distance, cdf - static_cast<double>(i) / samples, static_cast<double>(i + 1) / samples - cdf});
  }
  CHECK(distance * std::sqrt(samples) < 2.4);
  // Counts beyond 2, 3 and 4 sigma on either side are binomial.
  for (const double limit : {2.0, 3.0, 4.0}) {
    const double p = 2.0 * normal_cdf(-limit);
    const auto beyond = std::count_if(values.begin(), values.end(), [&](double z) { return std::fabs(z) > limit; });
    CHECK(std::fabs(static_cast<double>(beyond) - samples * p) / std::sqrt(samples * p * (1.0 - p)) < z_limit);
  }
}

TEST_CASE("normals are independent within pairs, along trials, between draws, purposes and seeds") {
  const Stream stream(2018, "noise");
  const auto values = normals(stream);
  std::vector<double> even, odd, other_draw;
  for (std::size_t i = 0; i < values.size(); i += 2) {
    even.push_back(values[i]);
    odd.push_back(values[i + 1]);
  }
  for (std::size_t trial = 0; trial < pairs; ++trial) {
    other_draw.push_back(normal_pair(uniform_pair(stream.block(trial, 1)))[0]);
  }
  const std::vector<double> shifted(even.begin() + 1, even.end());
  CHECK(std::fabs(correlation_z(even, odd)) < z_limit);
  CHECK(std::fabs(correlation_z(even, shifted)) < z_limit);
  CHECK(std::fabs(correlation_z(even, other_draw)) < z_limit);
  CHECK(std::fabs(correlation_z(values, normals(Stream(2018, "start")))) < z_limit);
  CHECK(std::fabs(correlation_z(values, normals(Stream(2019, "noise")))) < z_limit);
  // Squares too: numbers can be uncorrelated and still depend on each other. Var(z^2 - 1) = 2.
  std::vector<double> even_squares, odd_squares;
  for (const double z : even) even_squares.push_back((z * z - 1.0) / std::sqrt(2.0));
  for (const double z : odd) odd_squares.push_back((z * z - 1.0) / std::sqrt(2.0));
  CHECK(std::fabs(correlation_z(even_squares, odd_squares)) < z_limit);
}

TEST_CASE("three uniforms of a block are uniform and independent") {
  const Stream stream(5, "scene");
  std::array<std::vector<double>, 3> centred;
  std::array<std::array<double, 64>, 3> counts{};
  for (std::size_t trial = 0; trial < pairs; ++trial) {
    const auto u = uniform_triple(stream.block(trial, 3));
    for (std::size_t i = 0; i < 3; ++i) {
      centred[i].push_back((u[i] - 0.5) * std::sqrt(12.0));
      counts[i][static_cast<std::size_t>(u[i] * 64.0)] += 1.0;
    }
  }
  const double expected = static_cast<double>(pairs) / 64.0;
  for (const auto& histogram : counts) {
    double chi2 = 0.0;
    for (const double count : histogram) chi2 += (count - expected) * (count - expected) / expected;
    CHECK(chi2 < 127.0);  // chi-square with 63 degrees of freedom: exceeded with probability 4e-6
  }
  CHECK(std::fabs(correlation_z(centred[0], centred[1])) < z_limit);
  CHECK(std::fabs(correlation_z(centred[0], centred[2])) < z_limit);
  CHECK(std::fabs(correlation_z(centred[1], centred[2])) < z_limit);
}

TEST_CASE("unit vectors are uniform on the sphere") {
  const Stream stream(5, "start");
  std::array<double, 3> mean{};
  std::array<double, 3> square{};
  for (std::size_t trial = 0; trial < pairs; ++trial) {
    const auto v = unit_vector(uniform_pair(stream.block(trial, 0)));
    for (std::size_t i = 0; i < 3; ++i) {
      mean[i] += v[i];
      square[i] += v[i] * v[i];
    }
  }
  const auto n = static_cast<double>(pairs);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(std::fabs(mean[i] / n) * std::sqrt(3.0 * n) < z_limit);                         // variance 1/3
    CHECK(std::fabs(square[i] / n - 1.0 / 3.0) * std::sqrt(n / (4.0 / 45.0)) < z_limit);  // variance 1/5 - 1/9
  }
}
