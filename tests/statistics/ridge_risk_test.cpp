// The mean square error of a ridge with a constant k, simulated, against the formula of the textbooks.

#include <Eigen/Dense>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/sample.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

constexpr std::size_t trials = 200'000;
constexpr double sigma_m = 1e-4;
constexpr double offset_m = 1e-4;

/// sum_i (sigma^2 l_i + k^2 alpha_i^2) / (l_i + k)^2, J'J = Q diag(l) Q' at the truth, alpha = Q'(start - truth).
double risk(const Sample& sample, double k) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  const Eigen::Map<const Eigen::Vector3d> truth(sample.truth.data());
  for (const Point& p : sample.points) {
    const Eigen::Vector3d row = (truth - Eigen::Map<const Eigen::Vector3d>(p.data())).normalized();
    normal += row * row.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(normal);
  const Eigen::Vector3d alpha =
      eigen.eigenvectors().transpose() * (Eigen::Map<const Eigen::Vector3d>(sample.start.data()) - truth);
  double sum = 0.0;
  for (int i = 0; i < 3; ++i) {
    const double l = eigen.eigenvalues()(i);
    sum += (sigma_m * sigma_m * l + k * k * alpha(i) * alpha(i)) / ((l + k) * (l + k));
  }
  return sum;
}

}  // namespace

TEST_CASE("one step of rr with a constant k has the mean square error of the linear model") {
  // Start and noise are 10^-4 m at points metres away: the curvature of a range changes a step of length d by some
  // d^2 / |p - x|, here 10^-4 of it or less, and the mean square error by as much, against a standard error of 2 10^-3.
  //
  // Two scenes and four k, each within three standard errors: 1 - 0.9973^8, 2.1 % false alarms at most.
  std::mt19937_64 engine(2018);
  for (const std::size_t points : {4, 7}) {
    Sample sample = random_sample(engine, {.points = points, .sigma_m = 0.0, .offset_m = offset_m});
    const std::vector<double> exact = sample.measured;
    std::vector<Sample> all;
    for (std::size_t t = 0; t < trials; ++t) {
      for (std::size_t j = 0; j < points; ++j) sample.measured[j] = exact[j] + sigma_m * normal(engine);
      all.push_back(sample);
    }
    const auto problems = batch_of(all);
    for (const double k : {0.0, 0.1, 0.5, 2.0}) {
      auto options = steps(1);
      options.k = k_index("fixed");
      options.k_fixed = k;
      const auto s = solve("rr", problems, options);
      double sum = 0.0;
      double sum_of_squares = 0.0;
      for (std::size_t t = 0; t < trials; ++t) {
        const double squared = std::pow(distance(estimate(s, t), sample.truth), 2);
        sum += squared;
        sum_of_squares += squared * squared;
      }
      const auto n = static_cast<double>(trials);
      const double mean = sum / n;
      const double standard_error = std::sqrt((sum_of_squares / n - mean * mean) / n);
      const double expected = risk(sample, k);
      std::printf("%zu points, k %.1f: mean square error %.5e m^2, formula %.5e m^2, %.2f standard errors of %.1e\n",
                  points, k, mean, expected, (mean - expected) / standard_error, standard_error / mean);
      CHECK(std::abs(mean - expected) <= 3.0 * standard_error);
    }
  }
}
