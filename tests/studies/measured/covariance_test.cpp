#include "studies/measured/covariance.hpp"

#include <Eigen/Dense>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/catch.hpp"

using namespace ridgeloc;
using studies::Place;

namespace {

studies::Epoch epoch_at(const std::vector<Place>& objects) {
  studies::Epoch epoch;
  for (const Place& at : objects) epoch.readings.push_back({"", at, 1.0, 1.0});
  return epoch;
}

const std::vector<Place> room = {{0, 0, 2.5}, {8, 0, 2}, {8, 6, 0.5}, {0, 6, 1}, {4, 3, 3}};
const Place inside = {2.0, 1.5, 1.0};
const std::vector<double> residuals = {0.03, -0.01, 0.02, 0.05, -0.04};

}  // namespace

TEST_CASE("the covariance is the sandwich, computed anew with dense matrices") {
  const std::vector<double> weights = {1.0, 0.25, 3.0, 0.5, 2.0};
  for (const bool knows_height : {false, true}) {
    const Eigen::Index p = knows_height ? 2 : 3;
    Eigen::MatrixXd jacobian(5, p);
    for (Eigen::Index j = 0; j < 5; ++j) {
      const Place& at = room[static_cast<std::size_t>(j)];
      const Eigen::Vector3d to(inside[0] - at[0], inside[1] - at[1], inside[2] - at[2]);
      jacobian.row(j) = (to / to.norm()).head(p).transpose();
    }
    const Eigen::VectorXd w = Eigen::Map<const Eigen::VectorXd>(weights.data(), 5);
    const Eigen::MatrixXd bread = (jacobian.transpose() * w.asDiagonal() * jacobian).inverse();
    const Eigen::VectorXd e = Eigen::Map<const Eigen::VectorXd>(residuals.data(), 5);
    const double left_over = static_cast<double>(5 - p);
    const double sigma = std::sqrt(e.squaredNorm() / left_over);
    const Eigen::MatrixXd from_residuals =
        w.cwiseProduct(e).squaredNorm() / left_over * bread * jacobian.transpose() * jacobian * bread;
    const Eigen::MatrixXd from_sigma =
        0.01 * bread * jacobian.transpose() * w.cwiseAbs2().asDiagonal() * jacobian * bread;
    const auto check = [&](const studies::Uncertainty& found, const Eigen::MatrixXd& expected_part) {
      Eigen::Matrix3d expected = Eigen::Matrix3d::Zero();
      expected.topLeftCorner(p, p) = expected_part;
      REQUIRE(found.covariance);
      const Eigen::Matrix<double, 6, 1> upper{expected(0, 0), expected(0, 1), expected(0, 2),
                                              expected(1, 1), expected(1, 2), expected(2, 2)};
      for (std::size_t i = 0; i < 6; ++i)
        CHECK(std::abs((*found.covariance)[i] - upper[static_cast<Eigen::Index>(i)]) < 1e-14);
    };
    const auto found = studies::uncertainty_of(epoch_at(room), inside, weights, residuals, knows_height, std::nullopt);
    check(found, from_residuals);
    check(studies::uncertainty_of(epoch_at(room), inside, weights, residuals, knows_height, 0.1), from_sigma);
    REQUIRE(found.sigma_m);
    CHECK(std::abs(*found.sigma_m - sigma) < 1e-15);
    CHECK(std::abs(found.gdop - std::sqrt((jacobian.transpose() * jacobian).inverse().trace())) < 1e-12);
  }
}

TEST_CASE("the covariance does not change with the scale of the weights, and takes sigma as it is given") {
  const std::vector<double> weights = {1.0, 0.25, 3.0, 0.5, 2.0};
  std::vector<double> scaled = weights;
  for (double& weight : scaled) weight *= 1e6;
  const auto one = studies::uncertainty_of(epoch_at(room), inside, weights, residuals, false, 0.1);
  const auto other = studies::uncertainty_of(epoch_at(room), inside, scaled, residuals, false, 0.2);
  REQUIRE((one.covariance && other.covariance));
  for (std::size_t i = 0; i < 6; ++i) CHECK(std::abs(4.0 * (*one.covariance)[i] / (*other.covariance)[i] - 1.0) < 1e-9);
}

TEST_CASE("where nothing can be said about the uncertainty nothing is") {
  const std::vector<double> three(3, 1.0);
  const std::vector<Place> few(room.begin(), room.begin() + 3);
  const auto exact = studies::uncertainty_of(epoch_at(few), inside, three, std::vector<double>(3, 0.0), false, {});
  CHECK(!exact.sigma_m);
  CHECK(!exact.covariance);
  CHECK(std::isfinite(exact.gdop));

  // In the plane of the objects a range says nothing about the height above it.
  const std::vector<Place> flat = {{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 4, 1}};
  const auto singular = studies::uncertainty_of(epoch_at(flat), {1, 2, 1}, std::vector<double>(4, 1.0),
                                                std::vector<double>(4, 0.1), false, {});
  CHECK(std::isinf(singular.gdop));
  CHECK(!singular.covariance);
}
