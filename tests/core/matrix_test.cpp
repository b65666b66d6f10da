#include "core/matrix.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

using Matrix = core::Symmetric<double, 3>;
using Right = core::Vector<double, 3>;

core::Symmetric<double, 3> from(const Eigen::Matrix3d& m) {
  return {{m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)}};
}

}  // namespace

TEST_CASE("solve agrees with Eigen on definite and indefinite matrices") {
  std::mt19937_64 engine(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    Eigen::Matrix3d a;
    Eigen::Vector3d b;
    for (int r = 0; r < 3; ++r) {
      b(r) = normal(engine);
      for (int c = 0; c <= r; ++c) a(r, c) = a(c, r) = normal(engine);
    }
    const auto solution = core::solve(from(a), Right{b(0), b(1), b(2)});
    const Eigen::Vector3d x(solution.x[0], solution.x[1], solution.x[2]);
    const double condition = a.norm() * a.inverse().norm();
    // The adjugate loses at most cond^2 eps of the largest component; 64 covers the operations of the formula.
    const double bound = 64.0 * condition * condition * std::numeric_limits<double>::epsilon();
    CHECK((x - a.fullPivLu().solve(b)).norm() <= bound * x.norm());
    CHECK_FALSE(solution.singular);
  }
}

TEST_CASE("solve calls a matrix singular by Hadamard's bound, whatever the scale of its rows") {
  const Eigen::Vector3d u(0.6, 0.0, 0.8);
  const Eigen::Vector3d v(0.0, 1.0, 0.0);
  const Eigen::Matrix3d rank_two = u * u.transpose() + v * v.transpose();
  for (const double scale : {1e-30, 1.0, 1e30}) {
    CHECK(core::solve(from(scale * rank_two), Right{1.0, 1.0, 1.0}).singular);
    CHECK_FALSE(core::solve(from(scale * Eigen::Matrix3d::Identity()), Right{1.0, 1.0, 1.0}).singular);
  }
  CHECK(core::solve(Matrix{}, Right{1.0, 1.0, 1.0}).singular);

  // Diagonal matrices are as well conditioned as their rows are scaled: a ridge of 1e12 in one component alone.
  const auto scaled = core::solve(Matrix{{1e12, 0.1, 0.1, 2.0, 0.3, 1.0}}, Right{1e12, 2.0, 1.0});
  CHECK_FALSE(scaled.singular);
  CHECK(scaled.x[0] == Approx(1.0));
  const auto huge = core::solve(Matrix{{1e16, 0.1, 0.1, 2.0, 0.3, 1.0}}, Right{1e16, 2.6, 1.4});
  CHECK_FALSE(huge.singular);
  CHECK(huge.x[1] == Approx((2.5 - 0.3 * 1.3) / 1.91));
}

TEST_CASE("solve answers what is not finite with what is not finite, not with singular") {
  const double nan = std::nan("");
  const auto solution = core::solve(Matrix{{nan, 0.0, 0.0, 1.0, 0.0, 1.0}}, Right{1.0, 1.0, 1.0});
  CHECK_FALSE(solution.singular);
  CHECK_FALSE(std::isfinite(solution.x[0]));
}

TEST_CASE("the diagonal of the inverse is that of Eigen") {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 100; ++i) {
    Eigen::Matrix<double, 6, 4> rows;
    for (int e = 0; e < rows.size(); ++e) rows(e) = normal(engine);
    const Eigen::Matrix4d a = rows.transpose() * rows;
    core::Symmetric<double, 4> upper;
    for (std::size_t r = 0; r < 4; ++r) {
      for (std::size_t c = r; c < 4; ++c) upper(r, c) = a(static_cast<long>(r), static_cast<long>(c));
    }
    const auto diagonal = core::inverse_diagonal(core::factorize(upper));
    const Eigen::Matrix4d inverse = a.inverse();
    const double condition = a.norm() * inverse.norm();
    for (std::size_t d = 0; d < 4; ++d) {
      // A definite matrix loses cond eps to elimination without pivoting; 32 covers its operations.
      CHECK(diagonal[d] == Approx(inverse(static_cast<long>(d), static_cast<long>(d)))
                               .epsilon(32.0 * condition * std::numeric_limits<double>::epsilon()));
    }
  }
}

TEST_CASE("a matrix of many sums is singular where their rounding hides its rank") {
  // 1000 rows in a plane of three dimensions: rounding leaves a determinant of 1.6 eps in the median, 9 in 99 of 100.
  std::mt19937_64 engine(6);
  std::normal_distribution<double> normal;
  std::size_t regular = 0;
  for (int i = 0; i < 200; ++i) {
    Eigen::Matrix<double, 2, 3> basis;
    for (int e = 0; e < basis.size(); ++e) basis(e) = normal(engine);
    Eigen::Matrix3d a = Eigen::Matrix3d::Zero();
    for (int n = 0; n < 1000; ++n) {
      const Eigen::RowVector3d row = (normal(engine) * basis.row(0) + normal(engine) * basis.row(1)).normalized();
      a += row.transpose() * row;
    }
    CHECK(core::solve(from(a), Right{1.0, 1.0, 1.0}, 1000).singular);
    regular += core::solve(from(a), Right{1.0, 1.0, 1.0}).singular ? 0 : 1;
  }
  CHECK(regular > 20);  // this is why
}
