#include "core/symmetric_eigen.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>
#include <random>

#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// One type for all sizes: the reference is compiled once.
using Square = Eigen::MatrixXd;
using LongSquare = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

template <int P>
core::Symmetric<double, P> symmetric(const Square& m) {
  core::Symmetric<double, P> a;
  for (int i = 0; i < P; ++i) {
    for (int j = i; j < P; ++j) a(i, j) = m(i, j);
  }
  return a;
}

Square rotation(int size, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  Square m(size, size);
  for (int i = 0; i < size * size; ++i) m(i) = normal(engine);
  return Eigen::HouseholderQR<Square>(m).householderQ();
}

/// Eigenvalues, ascending.
template <int P>
Eigen::VectorXd sorted(const core::SymmetricEigen<double, P>& eigen) {
  Eigen::VectorXd values = Eigen::Map<const Eigen::VectorXd>(eigen.values.data(), P);
  std::sort(values.data(), values.data() + P);
  return values;
}

template <int P>
Square vectors(const core::SymmetricEigen<double, P>& eigen) {
  Square q(P, P);
  for (int i = 0; i < P; ++i) {
    for (int j = 0; j < P; ++j) q(j, i) = eigen.vectors[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  }
  return q;
}

/// Rounding of a few sweeps of P (P - 1) / 2 rotations, each of which costs some eps of the largest element.
template <int P>
constexpr double rounding = 16.0 * P*(P - 1) * epsilon;

template <int P>
void check_against_eigen(const Square& m) {
  const auto eigen = core::symmetric_eigen(symmetric<P>(m));
  const Eigen::SelfAdjointEigenSolver<Square> reference(m);
  const Square q = vectors<P>(eigen);
  const double size = m.norm();
  CHECK((sorted<P>(eigen) - reference.eigenvalues()).norm() <= rounding<P> * size);
  CHECK((q.transpose() * q - Square::Identity(P, P)).norm() <= rounding<P>);
  const auto values = Eigen::Map<const Eigen::VectorXd>(eigen.values.data(), P);
  CHECK((q * values.asDiagonal() * q.transpose() - m).norm() <= rounding<P> * size);
}

template <int P>
void check_many() {
  std::mt19937_64 engine(P);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int round = 0; round < 500; ++round) {
    const Square q = rotation(P, engine);
    Eigen::VectorXd values(P);
    for (int i = 0; i < P; ++i) values(i) = uniform(engine);
    switch (round % 5) {
      case 1:  // nearly equal
        for (int i = 0; i < P; ++i) values(i) = 1.0 + 1e-14 * values(i);
        break;
      case 2:  // rank one
        values.tail(P - 1).setZero();
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
    const Square m = q * values.asDiagonal() * q.transpose();
    check_against_eigen<P>(0.5 * (m + m.transpose()));
  }
  check_against_eigen<P>(Square::Zero(P, P));
  check_against_eigen<P>(Square::Identity(P, P));
  check_against_eigen<P>(Square::Ones(P, P));
}

/// Matrices D C D with D from 1 to 10^-6: their entries fix even the smallest eigenvalue to cond(C) eps. It is found
/// as the inverse of the largest of the inverse, which a factorization in long double knows as well; and the product of
/// all from the determinant.
template <int P>
void check_relative() {
  std::mt19937_64 engine(100 + P);
  std::uniform_real_distribution<double> uniform(-0.25, 0.25);
  for (int round = 0; round < 200; ++round) {
    Square m = Square::Identity(P, P);
    for (int i = 0; i < P; ++i) {
      for (int j = 0; j < i; ++j) m(i, j) = m(j, i) = uniform(engine);
    }
    // Gershgorin: cond(C) <= (1 + 3 / 4) / (1 - 3 / 4) = 7.
    constexpr double bound = 7.0 * rounding<P>;
    Eigen::VectorXd d(P);
    for (int i = 0; i < P; ++i) d(i) = std::exp2(-20.0 * i / (P - 1));
    m = (d.asDiagonal() * m * d.asDiagonal()).eval();
    const auto values = sorted<P>(core::symmetric_eigen(symmetric<P>(m)));

    const LongSquare exact = m.cast<long double>();
    const Eigen::LLT<LongSquare> factors(exact);
    const LongSquare inverse = factors.solve(LongSquare::Identity(P, P));
    const Eigen::SelfAdjointEigenSolver<LongSquare> of_inverse(0.5L * (inverse + inverse.transpose()));
    const double smallest = static_cast<double>(1.0L / of_inverse.eigenvalues()(P - 1));
    const LongSquare lower = factors.matrixL();
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
