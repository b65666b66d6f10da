#pragma once

#include <array>
#include <cstddef>

#include "core/matrix3.hpp"
#include "core/problem.hpp"
#include "core/real.hpp"

namespace ridgeloc::solvers {

/// A number of points that is known only when the program runs.
inline constexpr std::size_t any_points = 0;

/// The score of every observation of a problem without scores. Multiplying by it costs nothing.
struct UnitScore {
  friend constexpr UnitScore operator*(UnitScore, UnitScore) { return {}; }
  template <class Real>
  friend const Real& operator*(UnitScore, const Real& x) {
    return x;
  }
};

/// One range observation, linearised at a position.
template <class Real>
struct RangeObservation {
  core::Vector3<Real> direction;  ///< row of the Jacobian: de/dx = (x - p) / |x - p|
  Real residual;                  ///< e = |p - x| - m (m)
};

/// The range model of one trial per lane, unknown x = (x, y, z): e_j(x) = |p_j - x| - m_j.
/// At a point itself the direction, and with it every step, is not a number. `Points` fixes the number of points when
/// the program is compiled, so that loops over them unroll; `Scored` says whether the observations have scores.
template <class RealType, std::size_t Points = any_points, bool Scored = false>
class RangeModel {
 public:
  using Real = RealType;
  static_assert(core::lanes<Real> <= core::ProblemBatch::largest_lanes);

  /// The trials in the slots slot, slot + 1, ... of a batch. Lanes beyond its end hold unspecified numbers.
  RangeModel(const core::ProblemBatch& problems, std::size_t slot)
      : first_(problems.data() + slot), stride_(problems.stride()), points_(problems.points()) {}

  std::size_t points() const {
    if constexpr (Points == any_points) return points_;
    return Points;
  }

  core::Vector3<Real> start() const {
    const std::size_t column = core::ProblemBatch::start_column(points(), 0);
    return {value(column), value(column + 1), value(column + 2)};
  }

  auto score(std::size_t j) const {
    if constexpr (Scored) {
      return value(core::ProblemBatch::score_column(points(), j));
    } else {
      return UnitScore{};
    }
  }

  RangeObservation<Real> observe(std::size_t j, const core::Vector3<Real>& x) const {
    const core::Vector3<Real> d = from_point(j, x);
    const auto [range, inverse] = core::root_and_inverse(core::dot(d, d));
    return {{d[0] * inverse, d[1] * inverse, d[2] * inverse}, range - measured(j)};
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
    const Real squares_change = core::neg_mul_add(Real(2.0), core::dot(dx, before), core::dot(dx, dx));
    return {range - measured(j), squares_change * core::reciprocal(range + core::sqrt(core::dot(after, after)))};
  }

  Real residual(std::size_t j, const core::Vector3<Real>& x) const {
    const core::Vector3<Real> d = from_point(j, x);
    return core::sqrt(core::dot(d, d)) - measured(j);
  }

 private:
  Real value(std::size_t column) const { return core::load<Real>(first_ + column * stride_); }
  Real measured(std::size_t j) const { return value(core::ProblemBatch::measured_column(j)); }

  core::Vector3<Real> from_point(std::size_t j, const core::Vector3<Real>& x) const {
    const std::size_t column = core::ProblemBatch::position_column(j, 0);
    return {x[0] - value(column), x[1] - value(column + 1), x[2] - value(column + 2)};
  }

  const double* first_;
  std::size_t stride_;
  std::size_t points_;
};

}  // namespace ridgeloc::solvers
