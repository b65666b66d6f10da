// Statistical tests of simulated photos and of what is detected in them. |z| > 4.5 has a false-alarm rate of 7e-6, for
// every number that is compared; the chi-square bounds are stated where they stand.

#include <array>
#include <cmath>
#include <vector>

#include "sim/photo.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hall.hpp"

using namespace ridgeloc;
using tests::hall;
using tests::object_at;

namespace {

constexpr std::size_t trials = 100'000;
constexpr double z_limit = 4.5;

/// Chi-square of values in [0, 1] over 32 bins against uniform: above 76 with probability 1.1e-5 (31 degrees of
/// freedom).
double chi_square(const std::vector<double>& values) {
  std::array<double, 32> counts{};
  for (const double v : values) counts[std::min(static_cast<std::size_t>(v * 32.0), std::size_t{31})] += 1.0;
  const double expected = static_cast<double>(values.size()) / 32.0;
  double chi2 = 0.0;
  for (const double count : counts) chi2 += (count - expected) * (count - expected) / expected;
  return chi2;
}
constexpr double chi_square_limit = 76.0;

/// z of a number of successes among n.
double z_of_rate(std::size_t successes, std::size_t n, double rate) {
  return (static_cast<double>(successes) - static_cast<double>(n) * rate) /
         std::sqrt(static_cast<double>(n) * rate * (1.0 - rate));
}

/// z of the mean square of normal values whose mean is 0.
double z_of_sigma(const std::vector<double>& values, double sigma) {
  double squares = 0.0;
  for (const double v : values) squares += v * v;
  const auto n = static_cast<double>(values.size());
  return (squares / n / (sigma * sigma) - 1.0) * std::sqrt(n / 2.0);
}

/// z of the correlation of values whose means are 0.
double z_of_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  double aa = 0.0;
  double bb = 0.0;
  double ab = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += a[i] * a[i];
    bb += b[i] * b[i];
    ab += a[i] * b[i];
  }
  return ab / std::sqrt(aa * bb) * std::sqrt(static_cast<double>(a.size()));
}

const sim::Box truth{300.0, -40.0, 100.0, 200.0};

/// Detections of one object in as many trials, found or not.
std::vector<std::optional<sim::Detection>> detections(const sim::DetectorModel& model, double range_m = 5.0) {
  const sim::BuildingMap map = hall({object_at(5, 0, 1.5)});
  const sim::View view{0, truth, range_m, range_m};
  const core::Stream stream = sim::detector_stream(2018);
  std::vector<std::optional<sim::Detection>> found;
  for (std::uint64_t t = 0; t < trials; ++t) found.push_back(sim::detect(model, map, view, stream, t, 0));
  return found;
}

sim::DetectorModel sure() {
  sim::DetectorModel model;
  model.recall_near = model.recall_far = 1.0;
  return model;
}

}  // namespace

TEST_CASE("objects are found as often as the recall says, near and far") {
  const sim::DetectorModel model;
  for (const double range_m : {5.0, 12.0}) {
    std::size_t found = 0;
    for (const auto& d : detections(model, range_m)) found += d ? 1 : 0;
    CHECK(std::fabs(z_of_rate(found, trials, range_m < 10.0 ? model.recall_near : model.recall_far)) < z_limit);
  }
}

TEST_CASE("false classes come as often as asked for, each other class equally") {
  sim::DetectorModel model = sure();
  model.false_class_rate = 0.2;
  std::array<std::size_t, 3> counts{};
  for (const auto& d : detections(model)) ++counts[d->object_class];
  CHECK(std::fabs(z_of_rate(counts[0], trials, 0.8)) < z_limit);
  CHECK(std::fabs(z_of_rate(counts[1], trials, 0.1)) < z_limit);
}

TEST_CASE("heights, widths and centres of boxes scatter as independent edges do") {
  sim::DetectorModel model = sure();
  model.edge_sigma = 0.05;
  model.outlier_rate = 0.0;
  model.centre_sigma = 0.03;
  std::vector<double> height, width, x, y;
  for (const auto& d : detections(model)) {
    height.push_back(d->box.height_px / truth.height_px - 1.0);
    width.push_back(d->box.width_px / truth.width_px - 1.0);
    x.push_back((d->box.x_px - truth.x_px) / truth.width_px);
    y.push_back((d->box.y_px - truth.y_px) / truth.height_px);
  }
  const double size = 0.05 * std::sqrt(2.0);
  const double centre = std::sqrt(0.05 * 0.05 / 2.0 + 0.03 * 0.03);
  CHECK(std::fabs(z_of_sigma(height, size)) < z_limit);
  CHECK(std::fabs(z_of_sigma(width, size)) < z_limit);
  CHECK(std::fabs(z_of_sigma(x, centre)) < z_limit);
  CHECK(std::fabs(z_of_sigma(y, centre)) < z_limit);
  CHECK(std::fabs(z_of_correlation(height, y)) < z_limit);
  CHECK(std::fabs(z_of_correlation(height, width)) < z_limit);
  CHECK(std::fabs(z_of_correlation(x, y)) < z_limit);
}

TEST_CASE("heights in the map are off by their standard deviation") {
  sim::DetectorModel model = sure();
  model.height_sigma = 0.1;  // at nine standard deviations the smallest height would matter
  std::vector<double> errors;
  for (const auto& d : detections(model)) errors.push_back(d->height_factor - 1.0);
  CHECK(std::fabs(z_of_sigma(errors, 0.1)) < z_limit);
}

TEST_CASE("outliers come as often as asked for, uniform in size, and in four equal cases") {
  sim::DetectorModel model = sure();
  model.edge_sigma = 0.0;
  model.outlier_rate = 0.3;
  std::vector<double> sizes;
  std::array<std::size_t, 4> cases{};
  for (const auto& d : detections(model)) {
    const double growth = d->box.height_px / truth.height_px - 1.0;
    if (growth == 0.0) continue;
    sizes.push_back((std::fabs(growth) - 0.15) / 0.25);
    ++cases[(growth < 0.0 ? 0U : 2U) + (d->box.y_px < truth.y_px ? 0U : 1U)];
  }
  CHECK(std::fabs(z_of_rate(sizes.size(), trials, 0.3)) < z_limit);
  CHECK(chi_square(sizes) < chi_square_limit);
  for (const std::size_t count : cases) CHECK(std::fabs(z_of_rate(count, sizes.size(), 0.25)) < z_limit);
}

TEST_CASE("scores without a link are uniform and tell nothing of the error") {
  sim::DetectorModel model = sure();
  model.outlier_rate = 0.0;
  std::vector<double> shares, centred, squares;
  for (const auto& d : detections(model)) {
    shares.push_back((d->score - 0.2) / 0.8);
    centred.push_back(shares.back() - 0.5);
    const double error = (d->box.height_px / truth.height_px - 1.0) / (0.06 * std::sqrt(2.0));
    squares.push_back(error * error - 1.0);
  }
  CHECK(chi_square(shares) < chi_square_limit);
  CHECK(std::fabs(z_of_correlation(centred, squares)) < z_limit);
}

TEST_CASE("as many scores tell of the error as are linked, and those are uniform to two hundredths") {
  sim::DetectorModel model = sure();
  model.outlier_rate = 0.0;
  model.score_link = 1.0;
  const auto linked = detections(model);
  model.score_link = 0.3;
  const auto some = detections(model);
  std::size_t equal = 0;
  std::array<std::size_t, 9> above{};
  for (std::size_t t = 0; t < trials; ++t) {
    equal += some[t]->score == linked[t]->score ? 1 : 0;
    for (std::size_t i = 0; i < above.size(); ++i) {
      above[i] += (linked[t]->score - 0.2) / 0.8 > 0.1 * static_cast<double>(i + 1) ? 1 : 0;
    }
  }
  CHECK(std::fabs(z_of_rate(equal, trials, 0.3)) < z_limit);
  // The normal distribution is approximated there: 0.02, and 4.5 standard errors of at most 0.0016.
  for (std::size_t i = 0; i < above.size(); ++i) {
    const double share = static_cast<double>(above[i]) / static_cast<double>(trials);
    CHECK(std::fabs(share - (1.0 - 0.1 * static_cast<double>(i + 1))) < 0.02 + z_limit * 0.0016);
  }
}

TEST_CASE("photos are taken uniformly over the areas and into all directions, tilted as asked for") {
  sim::BuildingMap map = hall({object_at(5, 0, 1.5)});
  map.areas = {{"large", {0.0, 30.0}, {0.0, 2.0}}, {"small", {0.0, 10.0}, {2.0, 4.0}}};
  sim::PhotoOptions options;
  options.wall_distance_m = 0.0;
  options.least_visible = 0;
  options.pitch_sigma_deg = 2.0;
  options.roll_sigma_deg = 0.5;
  const sim::DetectorModel detector;
  const sim::PhotoTaker taker(map, options, detector, 2018);
  std::vector<double> x, y, heading, pitch, roll;
  std::size_t in_large = 0;
  sim::Photo photo;
  for (std::uint64_t t = 0; t < trials; ++t) {
    REQUIRE(taker.take_one(t, 0, photo));
    heading.push_back(photo.pose.heading_turns);
    pitch.push_back(360.0 * photo.pose.pitch_turns);
    roll.push_back(360.0 * photo.pose.roll_turns);
    if (photo.pose.position_m[1] > 2.0) continue;
    ++in_large;
    x.push_back(photo.pose.position_m[0] / 30.0);
    y.push_back(photo.pose.position_m[1] / 2.0);
  }
  CHECK(std::fabs(z_of_rate(in_large, trials, 0.75)) < z_limit);
  CHECK(chi_square(x) < chi_square_limit);
  CHECK(chi_square(y) < chi_square_limit);
  CHECK(chi_square(heading) < chi_square_limit);
  CHECK(std::fabs(z_of_sigma(pitch, 2.0)) < z_limit);
  CHECK(std::fabs(z_of_sigma(roll, 0.5)) < z_limit);
  CHECK(std::fabs(z_of_correlation(pitch, roll)) < z_limit);
}
