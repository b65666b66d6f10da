// Factorization of 2, 4 and 5 unknowns against Eigen; three have a form of their own, see matrix_test.cpp.

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

#include "core/matrix.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <int P>
struct System {
  Eigen::Matrix<double, P, P> matrix;
  Eigen::Matrix<double, P, 1> right;
};

template <int P>
core::LinearSolution<double, P> solve(const System<P>& s) {
  core::Symmetric<double, P> a;
  core::Vector<double, P> b;
  for (int i = 0; i < P; ++i) {
    b[static_cast<std::size_t>(i)] = s.right(i);
    for (int j = i; j < P; ++j) a(i, j) = s.matrix(i, j);
  }
  return core::solve(a, b);
}

template <int P>
System<P> random_definite(std::mt19937_64& engine, int rank) {
  std::normal_distribution<double> normal;
  Eigen::Matrix<double, Eigen::Dynamic, P> rows(rank, P);
  System<P> s;
  for (int i = 0; i < rank * P; ++i) rows(i) = normal(engine);
  for (int i = 0; i < P; ++i) s.right(i) = normal(engine);
  s.matrix = rows.transpose() * rows;
  return s;
}

template <int P>
void check() {
  std::mt19937_64 engine(10 + P);
  std::size_t regular_as_singular = 0;
  std::size_t singular_as_regular = 0;
  for (int round = 0; round < 1000; ++round) {
    const System<P> s = random_definite<P>(engine, P + 2);
    const auto solution = solve(s);
    const Eigen::Map<const Eigen::Matrix<double, P, 1>> x(solution.x.data());
    const double condition = s.matrix.norm() * s.matrix.inverse().norm();
    // A definite matrix loses cond eps to elimination without pivoting; 8 P covers its operations.
    CHECK((x - s.matrix.fullPivLu().solve(s.right)).norm() <= 8.0 * P * condition * epsilon * x.norm());
    regular_as_singular += solution.singular && condition < 1e8 ? 1 : 0;
    singular_as_regular += solve(random_definite<P>(engine, P - 1)).singular ? 0 : 1;
  }
  CHECK(regular_as_singular == 0);
  // What rounding leaves of the last pivot is a few eps of its row; the bound is P eps of the product of all. A few in
  // a thousand fall beyond it.
  CHECK(singular_as_regular <= 10);
}

template <int P>
void check_scaled() {
  for (const double scale : {1e-20, 1.0, 1e20}) {
    System<P> s;
    s.matrix = scale * Eigen::Matrix<double, P, P>::Identity();
    s.right.setConstant(2.0 * scale);
    CHECK_FALSE(solve(s).singular);
    CHECK(solve(s).x[P - 1] == Approx(2.0).epsilon(2.0 * epsilon));
    s.matrix.setConstant(scale);
    CHECK(solve(s).singular);
    // A ridge of 10^16 in one component alone is a scaled row, no singularity.
    s.matrix = scale * (Eigen::Matrix<double, P, P>::Identity() + Eigen::Matrix<double, P, P>::Ones());
    s.matrix(0, 0) *= 1e16;
    CHECK_FALSE(solve(s).singular);
  }
  System<P> s;
  s.right.setOnes();
  s.matrix.setZero();
  CHECK(solve(s).singular);
  s.matrix.setIdentity();
  s.matrix(0, 0) = std::nan("");
  CHECK_FALSE(solve(s).singular);
  CHECK_FALSE(std::isfinite(solve(s).x[0]));
}

}  // namespace

TEST_CASE("factorize and solve agree with Eigen for 2, 4 and 5 unknowns, and tell what is singular") {
  check<2>();
  check<4>();
  check<5>();
}

TEST_CASE("what is singular does not depend on the scale") {
  check_scaled<2>();
  check_scaled<4>();
  check_scaled<5>();
}
