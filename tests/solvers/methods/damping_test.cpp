// The damping schedule of lm against an independent transcription with Eigen, in extended precision so that its
// comparison of costs is not decided by rounding.

#include <Eigen/Dense>

#include "tests/support/catch.hpp"
#include "tests/support/hand_scene.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

const std::vector<Point> points = {{4, -0.5, 0.5}, {5.5, 3, -2}, {5, -0.5, 2}, {4.5, 1.5, -1.5}};
const std::vector<double> measured = {4.1, 6.8, 5.4, 4.9};

using Vector3 = Eigen::Matrix<long double, 3, 1>;
using Vector4 = Eigen::Matrix<long double, 4, 1>;

Vector3 point(int j) {
  return Eigen::Map<const Eigen::Vector3d>(points[static_cast<std::size_t>(j)].data()).cast<long double>();
}

Vector4 residual(const Vector3& x) {
  Vector4 e;
  for (int j = 0; j < 4; ++j) {
    e(j) = (x - point(j)).norm() - measured[static_cast<std::size_t>(j)];
  }
  return e;
}

Eigen::Matrix<long double, 4, 3> jacobian(const Vector3& x) {
  Eigen::Matrix<long double, 4, 3> rows;
  for (int j = 0; j < 4; ++j) {
    rows.row(j) = (x - point(j)).normalized().transpose();
  }
  return rows;
}

}  // namespace

TEST_CASE("lm follows mu: 0, then 1e-3 on the first rejection, ten times on each, a tenth on acceptance") {
  const Point start{3, 0.5, -3};
  const auto p = problem(points, measured, start);
  Vector3 x(start[0], start[1], start[2]);
  long double mu = 0.0;
  int rejections = 0;
  int acceptances_after = 0;
  for (int count = 1; count <= 15; ++count) {
    const auto rows = jacobian(x);
    Eigen::Matrix<long double, 3, 3> a = rows.transpose() * rows;
    a.diagonal() *= 1.0L + mu;
    const Vector3 next = x - a.inverse() * (rows.transpose() * residual(x));
    if (residual(next).squaredNorm() > residual(x).squaredNorm()) {
      mu = mu > 0.0 ? mu * 10.0L : 1e-3L;
      ++rejections;
    } else {
      x = next;
      mu /= 10.0;
      acceptances_after += rejections > 0 ? 1 : 0;
    }
    CHECK(distance(estimate(solve("lm", p, steps(count))),
                   {static_cast<double>(x(0)), static_cast<double>(x(1)), static_cast<double>(x(2))}) < 1e-9);
  }
  CHECK(rejections > 1);
  CHECK(acceptances_after > 1);
}
