#pragma once

#include "core/matrix3.hpp"
#include "core/problem.hpp"
#include "core/real.hpp"

namespace ridgeloc::solvers {

/// One range observation, linearised at a position.
template <class Real>
struct RangeObservation {
  core::Vector3<Real> direction;  ///< row of the Jacobian: de/dx = (x - p) / |x - p|
  Real residual;                  ///< e = |p - x| - m (m)
};

/// The range model of one trial per lane, unknown x = (x, y, z): e_j(x) = |p_j - x| - m_j.
/// At a point itself the direction, and with it every step, is not a number.
template <class Real>
class RangeModel {
 public:
  RangeModel(const core::ProblemBatch& problems, core::Index<Real> trial) : problems_(problems), trial_(trial) {}

  std::size_t points() const { return problems_.points(); }

  core::Vector3<Real> start() const {
    return {core::load(problems_.start(0), trial_), core::load(problems_.start(1), trial_),
            core::load(problems_.start(2), trial_)};
  }

  Real score(std::size_t j) const {
    return problems_.has_scores() ? core::load(problems_.score(j), trial_) : Real(1.0);
  }

  RangeObservation<Real> observe(std::size_t j, const core::Vector3<Real>& x) const {
    const core::Vector3<Real> d = from_point(j, x);
    const Real squared = core::dot(d, d);
    const Real range = core::sqrt(squared);
    const Real inverse = Real(1.0) / range;
    return {{d[0] * inverse, d[1] * inverse, d[2] * inverse}, range - core::load(problems_.measured(j), trial_)};
  }

  /// e_j at x, and how much the step x <- x - dx changes it: r^2 changes by dx'(dx - 2 (x - p)), free of the
  /// cancellation that the difference of two residuals suffers.
  struct ResidualChange {
    Real residual;
    Real change;
  };
  ResidualChange residual_change(std::size_t j, const core::Vector3<Real>& x, const core::Vector3<Real>& dx) const {
    const core::Vector3<Real> before = from_point(j, x);
    const core::Vector3<Real> after = core::subtract(before, dx);
    const Real range = core::sqrt(core::dot(before, before));
    const Real squares_change = core::dot(dx, dx) - Real(2.0) * core::dot(dx, before);
    return {range - core::load(problems_.measured(j), trial_),
            squares_change / (range + core::sqrt(core::dot(after, after)))};
  }

  Real residual(std::size_t j, const core::Vector3<Real>& x) const {
    const core::Vector3<Real> d = from_point(j, x);
    return core::sqrt(core::dot(d, d)) - core::load(problems_.measured(j), trial_);
  }

 private:
  core::Vector3<Real> from_point(std::size_t j, const core::Vector3<Real>& x) const {
    return {x[0] - core::load(problems_.position(j, 0), trial_), x[1] - core::load(problems_.position(j, 1), trial_),
            x[2] - core::load(problems_.position(j, 2), trial_)};
  }

  const core::ProblemBatch& problems_;
  core::Index<Real> trial_;
};

}  // namespace ridgeloc::solvers
