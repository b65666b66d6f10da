#pragma once

#include <cstddef>

#include "core/matrix.hpp"
#include "core/problem.hpp"
#include "core/real.hpp"
#include "solvers/models/observation.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// Ranges of one trial per lane, unknown u = (x, y, z): e_j(u) = |p_j - u| - m_j.
/// At a point itself the row, and with it every step, is not a number. `Points` fixes the number of points when the
/// program is compiled, so that loops over them unroll; such models are for problems without scores and the exact
/// Jacobian.
template <class RealType, std::size_t Points = any_points>
class RangeModel {
 public:
  using Real = RealType;
  static constexpr std::size_t unknowns = 3;
  static constexpr std::size_t positions = 3;
  static constexpr std::size_t fixed_points = Points;
  static constexpr bool always_in_domain = true;
  using Vector = core::Vector<Real, unknowns>;
  static_assert(core::lanes<Real> <= core::ProblemBatch::largest_lanes);

  /// The trials in the slots slot, slot + 1, ... of a batch. Lanes beyond its end hold unspecified numbers.
  RangeModel(const core::ProblemBatch& problems, std::size_t slot, const SolverOptions& options)
      : first_(problems.data() + slot),
        stride_(problems.stride()),
        points_(problems.points()),
        has_scores_(problems.has_scores()),
        printed_(options.jacobian == Jacobian::Printed) {}

  std::size_t points() const {
    if constexpr (Points == any_points) return points_;
    return Points;
  }

  auto score(std::size_t j) const {
    if constexpr (Points == any_points) {
      return has_scores_ ? value(core::ProblemBatch::score_column(points(), j)) : Real(1.0);
    } else {
      return UnitScore{};
    }
  }

  Vector start() const {
    const std::size_t column = core::ProblemBatch::start_column(points(), 0);
    return {value(column), value(column + 1), value(column + 2)};
  }
  Vector given(const core::Vector3<Real>& position, const Real&) const { return position; }
  core::Vector3<Real> position(const Vector& u) const { return u; }
  Real image_distance(const Vector&) const { return Real(0.0); }

  [[gnu::always_inline]] Observation<Real, unknowns> observe(std::size_t j, const Vector& u) const {
    const Vector d = from_point(j, u);
    const auto [range, inverse] = core::root_and_inverse(core::dot(d, d));
    if (Points == any_points && printed_) return {core::scale(-inverse, d), squares_difference(range, measured(j))};
    return {core::scale(inverse, d), range - measured(j)};
  }

  [[gnu::always_inline]] Real residual(std::size_t j, const Vector& u) const {
    const Vector d = from_point(j, u);
    const Real range = core::sqrt(core::dot(d, d));
    if (Points == any_points && printed_) return squares_difference(range, measured(j));
    return range - measured(j);
  }

  /// r^2 changes by du'(du - 2 (u - p)), free of the cancellation that the difference of two residuals suffers.
  [[gnu::always_inline]] ResidualChange<Real> residual_change(std::size_t j, const Vector& u, const Vector& du) const {
    const Vector before = from_point(j, u);
    const Vector after = core::subtract(before, du);
    const Real range = core::sqrt(core::dot(before, before));
    const Real squares_change = core::neg_mul_add(Real(2.0), core::dot(du, before), core::dot(du, du));
    if (Points == any_points && printed_) return {squares_difference(range, measured(j)), squares_change};
    return {range - measured(j), squares_change * core::reciprocal(range + core::sqrt(core::dot(after, after)))};
  }

  Observation<Real, unknowns> lifted(std::size_t j) const {
    const Vector p = from_point(j, start());
    const Real m = measured(j);
    return {core::scale(Real(-2.0), p), core::neg_mul_add(m, m, core::dot(p, p))};
  }
  /// How large the numbers are whose difference row j of the lifted equation is.
  Vector lifted_size(std::size_t j) const {
    const Vector origin = start();
    const std::size_t column = core::ProblemBatch::position_column(j, 0);
    return core::make_vector<unknowns>(
        [&](auto i) { return Real(2.0) * (core::abs(value(column + i)) + core::abs(origin[i])); });
  }
  Vector unlifted(const Vector& y) const {
    const Vector origin = start();
    return {origin[0] + y[0], origin[1] + y[1], origin[2] + y[2]};
  }
  core::Mask<Real> possible(const Vector& y) const { return y[0] <= y[0]; }

  Real squared_move(const Vector& du) const { return core::dot(du, du); }
  void add_prior(const Vector&, double, NormalEquations<Real, unknowns>&) const {}
  Real prior_change(const Vector&, const Vector&) const { return Real(0.0); }
  Real prior_squares(const Vector&) const { return Real(0.0); }
  std::size_t observations() const { return points(); }

 private:
  [[gnu::always_inline]] Real value(std::size_t column) const { return core::load<Real>(first_ + column * stride_); }
  Real measured(std::size_t j) const { return value(core::ProblemBatch::measured_column(j)); }
  static Real squares_difference(const Real& a, const Real& b) { return (a - b) * (a + b); }

  [[gnu::always_inline]] Vector from_point(std::size_t j, const Vector& u) const {
    const std::size_t column = core::ProblemBatch::position_column(j, 0);
    return {u[0] - value(column), u[1] - value(column + 1), u[2] - value(column + 2)};
  }

  const double* first_;
  std::size_t stride_;
  std::size_t points_;
  bool has_scores_;
  bool printed_;
};

}  // namespace ridgeloc::solvers
