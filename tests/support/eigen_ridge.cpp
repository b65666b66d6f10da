#include "tests/support/eigen_ridge.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

namespace ridgeloc::tests {

namespace {

long double median(Column values) {
  std::sort(values.begin(), values.end());
  return 0.5L * (values((values.size() - 1) / 2) + values(values.size() / 2));
}

long double geometric_mean(const Column& values) {
  return std::exp(values.array().log().mean());
}

}  // namespace

Matrix ridge_matrix(std::string_view name, const Linearised& problem, long double sigma2, bool canonical,
                    double k_fixed) {
  const long p = problem.rows.cols();
  const Matrix identity = Matrix::Identity(p, p);
  if (name == "fixed") return k_fixed * identity;
  const Matrix normal = problem.rows.transpose() * problem.rows;
  const Eigen::SelfAdjointEigenSolver<Matrix> eigen(normal);
  const Matrix q = canonical || name == "khalaf_shukur" ? Matrix(eigen.eigenvectors()) : identity;
  const Column alpha = q.transpose() * problem.step;
  const Column squared = alpha.cwiseAbs().cwiseMax(1e-9L).array().square();
  const Column each = sigma2 * squared.cwiseInverse();
  const Column m = each.cwiseSqrt();
  const long double l_max = eigen.eigenvalues().maxCoeff();
  const auto freedom = static_cast<long double>(problem.rows.rows() - p);

  if (name == "hk") return q * each.asDiagonal() * q.transpose();
  long double k = 0.0;
  if (name == "kibria_gm") {
    k = geometric_mean(each);
  } else if (name == "kibria_am") {
    k = each.mean();
  } else if (name == "kibria_med") {
    k = median(each);
  } else if (name == "hk_max") {
    k = sigma2 / squared.maxCoeff();
  } else if (name == "hkb") {
    k = static_cast<long double>(p) * sigma2 / problem.step.squaredNorm();
  } else if (name == "thisted") {
    k = static_cast<long double>(p - 2) * sigma2 / problem.step.squaredNorm();
  } else if (name == "lawless_wang") {
    const Column canonical_alpha = eigen.eigenvectors().transpose() * problem.step;
    k = static_cast<long double>(p) * sigma2 / (eigen.eigenvalues().array() * canonical_alpha.array().square()).sum();
  } else if (name == "khalaf_shukur") {
    k = l_max * sigma2 / (freedom * sigma2 + l_max * squared.maxCoeff());
  } else if (name == "mk2") {
    k = m.cwiseInverse().maxCoeff();
  } else if (name == "mk3") {
    k = m.maxCoeff();
  } else if (name == "mk4") {
    k = geometric_mean(m.cwiseInverse());
  } else if (name == "mk5") {
    k = geometric_mean(m);
  } else if (name == "mk6") {
    k = median(m.cwiseInverse());
  } else {
    throw std::invalid_argument(std::string(name));
  }
  return k * identity;
}

double gcv_score(const Eigen::MatrixXd& rows, const Eigen::VectorXd& errors, double k) {
  const long n = rows.rows();
  const long p = rows.cols();
  const Eigen::MatrixXd normal = rows.transpose() * rows + k * Eigen::MatrixXd::Identity(p, p);
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(n, n) - rows * normal.ldlt().solve(rows.transpose());
  return static_cast<double>(n) * (rest * errors).squaredNorm() / std::pow(rest.trace(), 2);
}

Column least_squares(const Matrix& rows, const Column& errors) {
  return rows.colPivHouseholderQr().solve(errors);
}

Column ridge_step(const Matrix& rows, const Column& errors, const Matrix& k) {
  return Matrix(rows.transpose() * rows + k).ldlt().solve(rows.transpose() * errors);
}

double condition(const Matrix& rows) {
  const Eigen::JacobiSVD<Matrix> svd(rows);
  const long double ratio = svd.singularValues()(0) / svd.singularValues()(rows.cols() - 1);
  return static_cast<double>(ratio * ratio);
}

}  // namespace ridgeloc::tests
