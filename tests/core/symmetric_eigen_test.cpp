#include "core/symmetric_eigen.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

template <int P>
using Square = Eigen::Matrix<double, P, P>;
template <int P>
using LongSquare = Eigen::Matrix<long double, P, P>;

template <int P>
core::Symmetric<double, P> symmetric(const Square<P>& m) {
  core::Symmetric<double, P> a;
  for (int i = 0; i < P; ++i) {
    for (int j = i; j < P; ++j) a(i, j) = m(i, j);
  }
  return a;
}

template <int P>
Square<P> rotation(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  Square<P> m;
  for (int i = 0; i < P * P; ++i) m(i) = normal(engine);
  return Eigen::HouseholderQR<Square<P>>(m).householderQ();
}

/// Eigenvalues, ascending.
template <int P>
Eigen::Matrix<double, P, 1> sorted(const core::SymmetricEigen<double, P>& eigen) {
  Eigen::Matrix<double, P, 1> values = Eigen::Map<const Eigen::Matrix<double, P, 1>>(eigen.values.data());
  std::sort(values.data(), values.data() + P);
  return values;
}

template <int P>
Square<P> vectors(const core::SymmetricEigen<double, P>& eigen) {
  Square<P> q;
  for (int i = 0; i < P; ++i) {
    for (int j = 0; j < P; ++j) q(j, i) = eigen.vectors[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  }
  return q;
}

/// Rounding of a few sweeps of P (P - 1) / 2 rotations, each of which costs some eps of the largest element.
template <int P>
constexpr double rounding = 16.0 * P*(P - 1) * epsilon;

template <int P>
void check_against_eigen(const Square<P>& m) {
  const auto eigen = core::symmetric_eigen(symmetric<P>(m));
  const Eigen::SelfAdjointEigenSolver<Square<P>> reference(m);
  const Square<P> q = vectors<P>(eigen);
  const double size = m.norm();
  CHECK((sorted<P>(eigen) - reference.eigenvalues()).norm() <= rounding<P> * size);
  CHECK((q.transpose() * q - Square<P>::Identity()).norm() <= rounding<P>);
  const auto values = Eigen::Map<const Eigen::Matrix<double, P, 1>>(eigen.values.data());
  CHECK((q * values.asDiagonal() * q.transpose() - m).norm() <= rounding<P> * size);
}

template <int P>
void check_many() {
  std::mt19937_64 engine(P);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int round = 0; round < 500; ++round) {
    const Square<P> q = rotation<P>(engine);
    Eigen::Matrix<double, P, 1> values;
    for (int i = 0; i < P; ++i) values(i) = uniform(engine);
    switch (round % 5) {
      case 1:  // nearly equal
        for (int i = 0; i < P; ++i) values(i) = 1.0 + 1e-14 * values(i);
        break;
      case 2:  // rank one
        values.template tail<P - 1>().setZero();
        break;
      case 3:  // hugely different
        for (int i = 0; i < P; ++i) values(i) = std::exp2(-40.0 * i);
        break;
      case 4:  // two equal
        values(1) = values(0);
        break;
      default:
        break;
    }
    const Square<P> m = q * values.asDiagonal() * q.transpose();
    check_against_eigen<P>(0.5 * (m + m.transpose()));
  }
  check_against_eigen<P>(Square<P>::Zero());
  check_against_eigen<P>(Square<P>::Identity());
  check_against_eigen<P>(Square<P>::Ones());
}

/// Matrices D C D with D from 1 to 10^-6: their entries fix even the smallest eigenvalue to cond(C) eps. It is found
/// as the inverse of the largest of the inverse, which a factorization in long double knows as well; and the product of
/// all from the determinant.
template <int P>
void check_relative() {
  std::mt19937_64 engine(100 + P);
  std::uniform_real_distribution<double> uniform(-0.25, 0.25);
  for (int round = 0; round < 200; ++round) {
    Square<P> m = Square<P>::Identity();
    for (int i = 0; i < P; ++i) {
      for (int j = 0; j < i; ++j) m(i, j) = m(j, i) = uniform(engine);
    }
    // Gershgorin: cond(C) <= (1 + 3 / 4) / (1 - 3 / 4) = 7.
    constexpr double bound = 7.0 * rounding<P>;
    Eigen::Matrix<double, P, 1> d;
    for (int i = 0; i < P; ++i) d(i) = std::exp2(-20.0 * i / (P - 1));
    m = d.asDiagonal() * m * d.asDiagonal();
    const auto values = sorted<P>(core::symmetric_eigen(symmetric<P>(m)));

    const LongSquare<P> exact = m.template cast<long double>();
    const Eigen::LLT<LongSquare<P>> factors(exact);
    const LongSquare<P> inverse = factors.solve(LongSquare<P>::Identity());
    const Eigen::SelfAdjointEigenSolver<LongSquare<P>> of_inverse(0.5L * (inverse + inverse.transpose()));
    const double smallest = static_cast<double>(1.0L / of_inverse.eigenvalues()(P - 1));
    const LongSquare<P> lower = factors.matrixL();
    const double determinant = static_cast<double>(std::pow(lower.diagonal().prod(), 2.0L));
    CHECK(std::abs(values(0) / smallest - 1.0) <= bound);
    CHECK(std::abs(values.prod() / determinant - 1.0) <= P * bound);
  }
}

}  // namespace

TEST_CASE("symmetric_eigen agrees with Eigen, whatever the eigenvalues") {
  check_many<2>();
  check_many<3>();
  check_many<4>();
}

TEST_CASE("symmetric_eigen finds small eigenvalues of definite matrices to relative accuracy") {
  check_relative<2>();
  check_relative<3>();
  check_relative<4>();
}

TEST_CASE("symmetric_eigen leaves a diagonal matrix as it is, and ends on what is not finite") {
  core::Symmetric<double, 3> a;
  for (const std::size_t i : {0U, 1U, 2U}) a(i, i) = 3.0 - static_cast<double>(i);
  const auto eigen = core::symmetric_eigen(a);
  CHECK(eigen.values == core::Vector<double, 3>{3.0, 2.0, 1.0});
  CHECK(eigen.vectors[1] == core::Vector<double, 3>{0.0, 1.0, 0.0});
  a(0, 1) = std::numeric_limits<double>::quiet_NaN();
  CHECK(std::isnan(core::symmetric_eigen(a).values[0]));
  a(0, 1) = std::numeric_limits<double>::infinity();
  CHECK_FALSE(std::isfinite(core::symmetric_eigen(a).values[0]));
}
