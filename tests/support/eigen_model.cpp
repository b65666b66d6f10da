#include "tests/support/eigen_model.hpp"

#include <cmath>

namespace ridgeloc::tests {

EigenModel::EigenModel(const Sample& sample, const solvers::SolverOptions& options)
    : sample_(sample), options_(options) {
  positions_ = options.z_mode == solvers::ZMode::Fixed ? 2 : 3;
  free_distance_ = sample.has_images() && options.v_mode != solvers::VMode::Fixed;
  start_ = Column(positions_ + (free_distance_ ? 1 : 0));
  for (long i = 0; i < positions_; ++i) start_(i) = sample.start[static_cast<std::size_t>(i)];
  if (free_distance_) start_(positions_) = sample.start_image_distance;
  scale_ = Column::Ones(start_.size());
  if (sample.has_images() && options.column_scale == solvers::ColumnScale::Norms) {
    scale_ = rows(start_).colwise().norm().transpose();
    start_ = start_.cwiseProduct(scale_);
  }
}

Column EigenModel::metric(const Column& u) const {
  Column x(4);
  for (long i = 0; i < 3; ++i) {
    x(i) = i < positions_ ? u(i) / scale_(i) : static_cast<long double>(sample_.start[static_cast<std::size_t>(i)]);
  }
  x(3) = free_distance_ ? u(positions_) / scale_(positions_) : static_cast<long double>(sample_.start_image_distance);
  return x;
}

Column EigenModel::residual(const Column& u) const {
  const Column x = metric(u);
  Column e(points());
  for (long j = 0; j < points(); ++j) {
    const auto index = static_cast<std::size_t>(j);
    const Column p = Eigen::Map<const Eigen::Vector3d>(sample_.points[index].data()).cast<long double>();
    const long double measured = sample_.measured[index];
    const long double range = (x.head(3) - p).norm();
    e(j) = range - (sample_.has_images() ? std::sqrt(sample_.alpha[index] * x(3) * x(3) + measured) : measured);
  }
  return e;
}

Matrix EigenModel::rows(const Column& u) const {
  const Column x = metric(u);
  Matrix j(points(), unknowns());
  for (long i = 0; i < points(); ++i) {
    const auto index = static_cast<std::size_t>(i);
    const Column p = Eigen::Map<const Eigen::Vector3d>(sample_.points[index].data()).cast<long double>();
    const Column towards = (x.head(3) - p).normalized();
    for (long axis = 0; axis < positions_; ++axis) j(i, axis) = towards(axis) / scale_(axis);
    if (free_distance_) {
      const long double alpha = sample_.alpha[index];
      j(i, positions_) = -alpha * x(3) / std::sqrt(alpha * x(3) * x(3) + sample_.measured[index]) / scale_(positions_);
    }
  }
  return j;
}

Column EigenModel::score_weights() const {
  Column w = Column::Ones(points());
  for (long j = 0; j < points() && !sample_.score.empty(); ++j) {
    w(j) = std::pow(static_cast<long double>(sample_.score[static_cast<std::size_t>(j)]), 2);
  }
  return w;
}

bool EigenModel::has_prior() const {
  return free_distance_ && options_.v_mode == solvers::VMode::Prior;
}

Matrix EigenModel::weighted_rows(const Column& u) const {
  Matrix a(points() + (has_prior() ? 1 : 0), unknowns());
  a.topRows(points()) = score_weights().cwiseSqrt().asDiagonal() * rows(u);
  if (has_prior()) {
    a.bottomRows(1).setZero();
    a(points(), positions_) = options_.sigma_prior_m / (0.005L * sample_.start_image_distance) / scale_(positions_);
  }
  return a;
}

Column EigenModel::weighted_errors(const Column& u) const {
  Column y(points() + (has_prior() ? 1 : 0));
  y.head(points()) = score_weights().cwiseSqrt().asDiagonal() * residual(u);
  if (has_prior()) {
    y(points()) = options_.sigma_prior_m / (0.005L * sample_.start_image_distance) *
                  (metric(u)(3) - sample_.start_image_distance);
  }
  return y;
}

Point EigenModel::position(const Column& u) const {
  const Column x = metric(u);
  return {static_cast<double>(x(0)), static_cast<double>(x(1)), static_cast<double>(x(2))};
}

long double EigenModel::move(const Column& du) const {
  return du.head(positions_).cwiseQuotient(scale_.head(positions_)).norm();
}

}  // namespace ridgeloc::tests
