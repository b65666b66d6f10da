#include "solvers/reference/reference_trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ridgeloc::solvers {

namespace {

/// Standard deviation of the prior on v, as a part of it.
constexpr double distance_prior = 0.005;

/// Of a residual, relative to what it is the difference of: see `gradient_rounding_bound`.
constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();

Eigen::Vector3d as_vector(const std::array<double, core::position_parameters>& values) {
  return Eigen::Vector3d::Map(values.data());
}

}  // namespace

ReferenceTrial::ReferenceTrial(const core::ProblemBatch& problems, std::size_t trial,
                               const ReferenceObjective& objective)
    : has_images_(problems.has_images()),
      height_is_free_(objective.z_mode == ZMode::Free),
      distance_is_free_(has_images_ && objective.v_mode != VMode::Fixed) {
  for (std::size_t axis = 0; axis < core::position_parameters; ++axis) {
    start_.position[axis] = problems.start(axis)[trial];
  }
  start_.image_distance_mm = has_images_ ? problems.start_image_distance()[trial] : 0.0;

  const std::size_t points = problems.points();
  const std::size_t robust_from = objective.robust_from > 0 ? static_cast<std::size_t>(objective.robust_from)
                                                            : static_cast<std::size_t>(unknowns()) + 1;
  const bool huber = objective.loss == ReferenceLoss::HuberTheta && points >= robust_from;
  if (huber) loss_ = {LossShape::Huber, 1.0, objective.theta_m, 0.0, 0.0};
  if (objective.loss == ReferenceLoss::Reweighted) loss_ = objective.robust;
  const double common = huber ? 1.0 / objective.theta_m : 1.0;
  const bool squared = objective.loss == ReferenceLoss::HuberTheta ? objective.score_power == ScorePower::Two
                                                                   : objective.score_power != ScorePower::One;
  double squares = 0.0;
  for (std::size_t j = 0; j < points; ++j) {
    ReferenceObservation o{};
    for (std::size_t axis = 0; axis < core::position_parameters; ++axis) {
      o.point[axis] = problems.position(j, axis)[trial];
    }
    o.measured = problems.measured(j)[trial];
    o.alpha = has_images_ ? problems.alpha(j)[trial] : 0.0;
    const double score = problems.has_scores() ? problems.score(j)[trial] : 1.0;
    o.factor = score < 0.0 ? std::numeric_limits<double>::quiet_NaN() : common * (squared ? score * score : score);
    observations_.push_back(o);
    const double v = start_.image_distance_mm;
    const double column = o.alpha * v / std::sqrt(o.alpha * v * v + o.measured);
    squares += column * column;
  }
  if (distance_is_free_) {
    const double scale = std::sqrt(squares / static_cast<double>(points));
    if (std::isfinite(scale) && scale > 0.0) distance_scale_ = scale;
    if (objective.v_mode == VMode::Prior) {
      const double relative = objective.sigma_prior_m / (distance_prior * start_.image_distance_mm);
      prior_factor_ = common * relative * relative;
    }
  }
  usable_ = is_usable(objective);
}

bool ReferenceTrial::is_usable(const ReferenceObjective& objective) const {
  const auto positive = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (objective.loss == ReferenceLoss::HuberTheta && loss_.shape == LossShape::Huber && !positive(loss_.scale_m)) {
    return false;
  }
  if (objective.loss == ReferenceLoss::Reweighted && !positive(loss_.scale_m * loss_.tuning)) return false;
  // Ceres ends the program at a derivative of the loss that is not positive.
  if (!(loss_.lift >= 0.0 && loss_.lift <= 1.0)) return false;
  if (!std::isfinite(prior_factor_) || !std::isfinite(start_.image_distance_mm)) return false;
  return std::ranges::all_of(observations_, [](const ReferenceObservation& o) {
    return as_vector(o.point).allFinite() && std::isfinite(o.measured) && std::isfinite(o.alpha) &&
           std::isfinite(o.factor);
  });
}

ReferenceTrial::Vector ReferenceTrial::unknowns_of(const ReferencePlace& place) const {
  Vector u(unknowns());
  u[0] = place.position[0];
  u[1] = place.position[1];
  if (height_is_free_) u[2] = place.position[2];
  if (distance_is_free_) {
    const double v = std::isnan(place.image_distance_mm) ? start_.image_distance_mm : place.image_distance_mm;
    u[u.size() - 1] = distance_scale_ * v;
  }
  return u;
}

ReferencePlace ReferenceTrial::place_of(const Vector& u) const {
  return {{u[0], u[1], height_is_free_ ? u[2] : start_.position[2]},
          distance_is_free_ ? u[u.size() - 1] / distance_scale_ : start_.image_distance_mm};
}

ReferenceTrial::Term ReferenceTrial::term(const ReferenceObservation& o, const Vector& u) const {
  const Eigen::Index positions = height_is_free_ ? 3 : 2;
  const ReferencePlace place = place_of(u);
  const Eigen::Vector3d away = as_vector(place.position) - as_vector(o.point);
  const double range = away.norm();
  const Eigen::Vector3d direction = away / range;

  Term t;
  t.row = Vector::Zero(u.size());
  t.bending = Matrix::Zero(u.size(), u.size());
  t.row.head(positions) = direction.head(positions);
  const Eigen::Matrix3d across = (Eigen::Matrix3d::Identity() - direction * direction.transpose()) / range;
  t.bending.topLeftCorner(positions, positions) = across.topLeftCorner(positions, positions);
  t.size = range + as_vector(place.position).norm();
  if (has_images_) {
    const double v = place.image_distance_mm;
    const double squared = o.alpha * v * v + o.measured;
    const double measured = std::sqrt(squared);
    t.residual = range - measured;
    if (distance_is_free_) {
      const Eigen::Index last = u.size() - 1;
      t.row[last] = -o.alpha * v / measured / distance_scale_;
      t.bending(last, last) = -o.alpha * o.measured / (measured * squared) / (distance_scale_ * distance_scale_);
    }
    const double cancelling = (2.0 * o.alpha * v * v + std::abs(o.measured)) / measured;
    t.size += measured + cancelling * (1.0 + std::abs(t.residual) / measured);
  } else {
    t.residual = range - o.measured;
    t.size += std::abs(o.measured);
  }
  const auto [value, first, second] = loss_(t.residual * t.residual);
  t.weight = o.factor * first;
  t.slope = o.factor * (first + 2.0 * t.residual * t.residual * second);
  return t;
}

std::vector<ReferenceTrial::Term> ReferenceTrial::terms(const Vector& u) const {
  std::vector<Term> all;
  all.reserve(observations_.size() + 1);
  for (const ReferenceObservation& o : observations_) all.push_back(term(o, u));
  if (prior_factor_ > 0.0) {
    const Eigen::Index last = u.size() - 1;
    const double v = u[last] / distance_scale_;
    Term prior{prior_factor_,
               prior_factor_,
               v - start_.image_distance_mm,
               Vector::Zero(u.size()),
               Matrix::Zero(u.size(), u.size()),
               std::abs(v) + std::abs(start_.image_distance_mm)};
    prior.row[last] = 1.0 / distance_scale_;
    all.push_back(prior);
  }
  return all;
}

std::vector<double> ReferenceTrial::residuals(const Vector& u) const {
  std::vector<double> values;
  for (const ReferenceObservation& o : observations_) values.push_back(term(o, u).residual);
  return values;
}

ReferenceTrial::Matrix ReferenceTrial::normal_matrix(const Vector& u) const {
  Matrix sum = Matrix::Zero(u.size(), u.size());
  for (const Term& t : terms(u)) sum += t.weight * t.row * t.row.transpose();
  return sum;
}

ReferenceTrial::Matrix ReferenceTrial::hessian(const Vector& u) const {
  Matrix sum = Matrix::Zero(u.size(), u.size());
  for (const Term& t : terms(u)) sum += t.slope * t.row * t.row.transpose() + t.weight * t.residual * t.bending;
  return sum;
}

double ReferenceTrial::rounding_bound(const Vector& u) const {
  double sum = 0.0;
  for (const Term& t : terms(u)) sum += t.weight * t.row.norm() * t.size;
  return rounding * sum;
}

double ReferenceTrial::cost_rounding(const Vector& u) const {
  double sum = 0.0;
  for (const Term& t : terms(u)) sum += t.weight * t.size * t.size;
  return 0.5 * rounding * rounding * sum;
}

}  // namespace ridgeloc::solvers
