#pragma once

#include <cstddef>

#include "core/matrix.hpp"
#include "core/problem.hpp"
#include "core/real.hpp"
#include "solvers/models/observation.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// Ranges of one trial per lane: e_j(u) = |p_j - x| - m_j. The unknowns u are the first `Positions` coordinates of x,
/// the others are the start's: with two of them the height is known. At a point itself the row, and with it every step,
/// is not a number. `Points` fixes the number of points when the program is compiled, so that loops over them unroll;
/// such models are for problems without scores and the exact Jacobian.
template <class RealType, std::size_t Points = any_points, std::size_t Positions = core::position_parameters>
class RangeModel {
 public:
  using Real = RealType;
  static constexpr std::size_t unknowns = Positions;
  static constexpr std::size_t positions = Positions;
  static constexpr std::size_t fixed_points = Points;
  static constexpr bool always_in_domain = true;
  using Vector = core::Vector<Real, unknowns>;
  static_assert(Positions == 2 || Positions == core::position_parameters);
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

  Vector start() const { return unknown_part({start(0), start(1), start(2)}); }
  Vector given(const core::Vector3<Real>& position, const Real&) const { return unknown_part(position); }
  core::Vector3<Real> position(const Vector& u) const { return place(u); }
  Real image_distance(const Vector&) const { return Real(0.0); }

  [[gnu::always_inline]] Observation<Real, unknowns> observe(std::size_t j, const Vector& u) const {
    const core::Vector3<Real> d = from_point(j, u);
    const auto [range, inverse] = core::root_and_inverse(core::dot(d, d));
    if (Points == any_points && printed_) {
      return {core::scale(-inverse, unknown_part(d)), squares_difference(range, measured(j))};
    }
    return {core::scale(inverse, unknown_part(d)), range - measured(j)};
  }

  [[gnu::always_inline]] Real residual(std::size_t j, const Vector& u) const {
    const core::Vector3<Real> d = from_point(j, u);
    const Real range = core::sqrt(core::dot(d, d));
    if (Points == any_points && printed_) return squares_difference(range, measured(j));
    return range - measured(j);
  }

  /// r^2 changes by du'(du - 2 (u - p)), free of the cancellation that the difference of two residuals suffers.
  [[gnu::always_inline]] ResidualChange<Real> residual_change(std::size_t j, const Vector& u, const Vector& du) const {
    const core::Vector3<Real> before = from_point(j, u);
    const core::Vector3<Real> after = core::subtract(before, whole(du));
    const Real range = core::sqrt(core::dot(before, before));
    const Real squares_change = core::neg_mul_add(Real(2.0), core::dot(du, unknown_part(before)), core::dot(du, du));
    if (Points == any_points && printed_) return {squares_difference(range, measured(j)), squares_change};
    return {range - measured(j), squares_change * core::reciprocal(range + core::sqrt(core::dot(after, after)))};
  }

  Observation<Real, unknowns> lifted(std::size_t j) const {
    const core::Vector3<Real> p = from_point(j, start());
    const Real m = measured(j);
    return {core::scale(Real(-2.0), unknown_part(p)), core::neg_mul_add(m, m, core::dot(p, p))};
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
    return core::make_vector<unknowns>([&](auto axis) { return origin[axis] + y[axis]; });
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

  Real start(std::size_t axis) const { return value(core::ProblemBatch::start_column(points(), axis)); }

  [[gnu::always_inline]] core::Vector3<Real> from_point(std::size_t j, const Vector& u) const {
    const std::size_t column = core::ProblemBatch::position_column(j, 0);
    const core::Vector3<Real>& at = place(u);
    return {at[0] - value(column), at[1] - value(column + 1), at[2] - value(column + 2)};
  }

  // From unknowns to coordinates and back. References where they are the same: copies would cost registers.
  [[gnu::always_inline]] decltype(auto) place(const Vector& u) const {
    if constexpr (Positions == core::position_parameters) {
      return (u);
    } else {
      return core::Vector3<Real>{u[0], u[1], start(2)};
    }
  }
  [[gnu::always_inline]] static decltype(auto) whole(const Vector& du) {
    if constexpr (Positions == core::position_parameters) {
      return (du);
    } else {
      return core::Vector3<Real>{du[0], du[1], Real(0.0)};
    }
  }
  [[gnu::always_inline]] static decltype(auto) unknown_part(const core::Vector3<Real>& d) {
    if constexpr (Positions == core::position_parameters) {
      return (d);
    } else {
      return Vector{d[0], d[1]};
    }
  }

  const double* first_;
  std::size_t stride_;
  std::size_t points_;
  bool has_scores_;
  bool printed_;
};

}  // namespace ridgeloc::solvers
