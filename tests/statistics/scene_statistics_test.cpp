// Statistical tests of simulated scenes; false-alarm rates as stated.

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/field_of_view.hpp"
#include "sim/range_noise.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

constexpr std::size_t trials = 200'000;

/// Chi-square of values in [0, 1) over 32 bins against uniform: above 76 with probability 1.1e-5 (31 degrees of
/// freedom).
double chi_square(const std::vector<double>& values) {
  std::array<double, 32> counts{};
  for (const double v : values) counts[static_cast<std::size_t>(v * 32.0)] += 1.0;
  const double expected = static_cast<double>(values.size()) / 32.0;
  double chi2 = 0.0;
  for (const double count : counts) chi2 += (count - expected) * (count - expected) / expected;
  return chi2;
}
constexpr double chi_square_limit = 76.0;

core::ProblemBatch scene(const sim::FieldOfView& view) {
  core::ProblemBatch problems;
  problems.reshape(2, trials);
  sim::place_objects(view, sim::SceneStreams(2018, view), 0, problems);
  return problems;
}

struct Spherical {
  double azimuth_deg, elevation_deg, depth_m;
};
Spherical spherical(const core::ProblemBatch& p, std::size_t t) {
  const double x = p.position(1, 0)[t];
  const double y = p.position(1, 1)[t];
  const double z = p.position(1, 2)[t];
  constexpr double degrees = 180.0 / std::numbers::pi;
  return {std::atan2(y, x) * degrees, std::atan2(z, std::hypot(x, y)) * degrees, std::hypot(x, y, z)};
}

}  // namespace

TEST_CASE("azimuth, elevation and depth are uniform") {
  const auto p = scene({});
  std::vector<double> azimuth, elevation, depth;
  for (std::size_t t = 0; t < trials; ++t) {
    const auto s = spherical(p, t);
    azimuth.push_back(std::fmin((s.azimuth_deg + 60.0) / 120.0, 0.999999));
    elevation.push_back(std::fmin((s.elevation_deg + 80.0) / 160.0, 0.999999));
    depth.push_back(std::fmin((s.depth_m - 1.0) / 9.0, 0.999999));
  }
  CHECK(chi_square(azimuth) < chi_square_limit);
  CHECK(chi_square(elevation) < chi_square_limit);
  CHECK(chi_square(depth) < chi_square_limit);
}

TEST_CASE("depth is uniform in volume where asked") {
  sim::FieldOfView view;
  view.depth_distribution = sim::DepthDistribution::Volume;
  const auto p = scene(view);
  std::vector<double> share;
  for (std::size_t t = 0; t < trials; ++t) {
    share.push_back(std::fmin((std::pow(spherical(p, t).depth_m, 3) - 1.0) / 999.0, 0.999999));
  }
  CHECK(chi_square(share) < chi_square_limit);
}

TEST_CASE("range noise has the standard deviation asked for and is independent between points") {
  auto p = scene({});
  sim::measure_ranges(sim::noise_registry()[0], {.range_sigma_m = 0.3}, core::Stream(2018, "noise"), 0, p);
  double mean = 0.0, square = 0.0, product = 0.0;
  const auto error = [&](std::size_t j, std::size_t t) {
    return p.measured(j)[t] - std::hypot(p.position(j, 0)[t], p.position(j, 1)[t], p.position(j, 2)[t]);
  };
  for (std::size_t t = 0; t < trials; ++t) {
    mean += error(0, t);
    square += error(0, t) * error(0, t);
    product += error(0, t) * error(1, t);
  }
  const auto n = static_cast<double>(trials);
  // |z| > 4.5 has a false-alarm rate of 7e-6 each.
  CHECK(std::fabs(mean / n) * std::sqrt(n) / 0.3 < 4.5);
  CHECK(std::fabs(square / n / 0.09 - 1.0) * std::sqrt(n / 2.0) < 4.5);
  CHECK(std::fabs(product / n / 0.09) * std::sqrt(n) < 4.5);
}
