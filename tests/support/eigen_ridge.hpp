#pragma once

#include <string_view>

#include "tests/support/eigen_model.hpp"

namespace ridgeloc::tests {

/// Estimators of K by their definitions, with explicit eigenvectors.
struct Linearised {
  Matrix rows;    ///< sqrt(W) J
  Column errors;  ///< sqrt(W) e
  Column step;    ///< the least-squares step that K is made from
};

/// K as a matrix. Not for gcv and the oracles.
Matrix ridge_matrix(std::string_view name, const Linearised& problem, long double sigma2, bool canonical,
                    double k_fixed);

/// n |(I - A)y|^2 / tr(I - A)^2 with A = J (J'J + k I)^-1 J' written out, J and y weighted.
double gcv_score(const Eigen::MatrixXd& rows, const Eigen::VectorXd& errors, double k);

/// Least squares by QR, and (J'J + K)^-1 J'y by Cholesky's factorization.
Column least_squares(const Matrix& rows, const Column& errors);
Column ridge_step(const Matrix& rows, const Column& errors, const Matrix& k);

/// Condition number of J'J.
double condition(const Matrix& rows);

}  // namespace ridgeloc::tests
