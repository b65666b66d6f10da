#pragma once

#include <cstddef>

#include "core/matrix.hpp"
#include "core/problem.hpp"
#include "core/real.hpp"
#include "solvers/models/observation.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// Standard deviation of the image distance in `VMode::Prior`, as a part of it.
inline constexpr double image_distance_prior = 0.005;

/// Pseudoranges of one trial per lane: |p_j - x|^2 = alpha_j v^2 + rho_j (RRR paper, eqs. 1, 2). The unknowns are the
/// first `Positions` coordinates of x (the others are the start's) and, if `FreeDistance`, the image distance v (mm);
/// otherwise v is the start's.
///
/// e_j = |p_j - x| - sqrt(alpha_j v^2 + rho_j), or as options.residual and options.jacobian say. Unknowns are scaled by
/// the norms of their columns of J at the start, u_i = |J_i| x_i, unless options.column_scale says otherwise: lengths
/// and image distances then compare, and K is formed in u.
template <class RealType, std::size_t Positions, bool FreeDistance>
class PseudorangeModel {
 public:
  using Real = RealType;
  static constexpr std::size_t positions = Positions;
  static constexpr std::size_t unknowns = Positions + (FreeDistance ? 1 : 0);
  static constexpr std::size_t fixed_points = any_points;
  static constexpr bool always_in_domain = false;
  using Vector = core::Vector<Real, unknowns>;

  PseudorangeModel(const core::ProblemBatch& problems, std::size_t slot, const SolverOptions& options)
      : problems_(problems), slot_(slot), options_(options) {
    for (std::size_t axis = 0; axis < 3; ++axis) start_position_[axis] = load(problems.start(axis));
    start_distance_ = load(problems.start_image_distance());
    inverse_scale_ = core::make_vector<unknowns>([](auto) { return Real(1.0); });
    scale_ = inverse_scale_;
    if (options.column_scale == ColumnScale::Norms) scale_columns();
    if (has_prior()) {
      const Real deviation = Real(image_distance_prior) * start_distance_;
      prior_weight_ = Real(options.sigma_prior_m * options.sigma_prior_m) * core::reciprocal(deviation * deviation);
    }
  }

  std::size_t points() const { return problems_.points(); }
  Real score(std::size_t j) const { return problems_.has_scores() ? load(problems_.score(j)) : Real(1.0); }

  Vector start() const { return given(start_position_, start_distance_); }
  Vector given(const core::Vector3<Real>& position, const Real& image_distance) const {
    return core::make_vector<unknowns>(
        [&](auto i) { return scale_[i] * (i < Positions ? position[i < 3 ? i : 0] : image_distance); });
  }
  core::Vector3<Real> position(const Vector& u) const {
    return core::make_vector<3>([&](auto i) {
      if constexpr (i < Positions) {
        return u[i] * inverse_scale_[i];
      } else {
        return start_position_[i];
      }
    });
  }
  Real image_distance(const Vector& u) const {
    if constexpr (FreeDistance) {
      return u[Positions] * inverse_scale_[Positions];
    } else {
      return start_distance_;
    }
  }

  Observation<Real, unknowns> observe(std::size_t j, const Vector& u) const {
    const core::Vector3<Real> d = core::subtract(position(u), point(j));
    const auto [range, inverse] = core::root_and_inverse(core::dot(d, d));
    const Real v = image_distance(u);
    const Real alpha = load(problems_.alpha(j));
    const Real squared = core::mul_add(alpha * v, v, load(problems_.measured(j)));
    Real towards = inverse;
    Real distance_row = -alpha * v * inverse;
    Real residual(0.0);
    if (options_.jacobian == Jacobian::Printed) {
      towards = -inverse;
      distance_row = Real(-2.0) * distance_row;
      residual = core::dot(d, d) - squared;
    } else if (options_.residual == Residual::Quotient) {
      residual = Real(0.5) * (core::dot(d, d) - squared) * inverse;
    } else {
      const auto [measured, inverse_measured] = core::root_and_inverse(squared);
      distance_row = -alpha * v * inverse_measured;
      residual = range - measured;
    }
    return {core::make_vector<unknowns>([&](auto i) {
              return inverse_scale_[i] * (i < Positions ? towards * d[i < 3 ? i : 0] : distance_row);
            }),
            residual};
  }

  Real residual(std::size_t j, const Vector& u) const {
    const core::Vector3<Real> d = core::subtract(position(u), point(j));
    const Real v = image_distance(u);
    const Real squared = core::mul_add(load(problems_.alpha(j)) * v, v, load(problems_.measured(j)));
    if (options_.jacobian == Jacobian::Printed) return core::dot(d, d) - squared;
    const Real range = core::sqrt(core::dot(d, d));
    if (options_.residual == Residual::Quotient) {
      return Real(0.5) * (core::dot(d, d) - squared) * core::reciprocal(range);
    }
    return range - core::sqrt(squared);
  }

  ResidualChange<Real> residual_change(std::size_t j, const Vector& u, const Vector& du) const {
    const Real before = residual(j, u);
    const Vector next = core::subtract(u, du);
    if (options_.jacobian == Jacobian::Printed || options_.residual == Residual::Quotient) {
      return {before, residual(j, next) - before};
    }
    const core::Vector3<Real> from = core::subtract(position(u), point(j));
    const core::Vector3<Real> to = core::subtract(position(next), point(j));
    const core::Vector3<Real> move = core::make_vector<3>([&](auto i) {
      if constexpr (i < Positions) {
        return du[i] * inverse_scale_[i];
      } else {
        return Real(0.0);
      }
    });
    const Real squares_change = core::neg_mul_add(Real(2.0), core::dot(move, from), core::dot(move, move));
    const Real range_change =
        squares_change * core::reciprocal(core::sqrt(core::dot(from, from)) + core::sqrt(core::dot(to, to)));
    if constexpr (!FreeDistance) return {before, range_change};
    const Real alpha = load(problems_.alpha(j));
    const Real rho = load(problems_.measured(j));
    const Real v = image_distance(u);
    const Real w = image_distance(next);
    const Real dv = du[unknowns - 1] * inverse_scale_[unknowns - 1];
    const Real measured_change =
        -alpha * dv * (v + w) *
        core::reciprocal(core::sqrt(core::mul_add(alpha * v, v, rho)) + core::sqrt(core::mul_add(alpha * w, w, rho)));
    return {before, range_change - measured_change};
  }

  Observation<Real, unknowns> lifted(std::size_t j) const {
    const core::Vector3<Real> p = core::subtract(point(j), start_position_);
    const Real alpha = load(problems_.alpha(j));
    Real rho = load(problems_.measured(j));
    if constexpr (!FreeDistance) rho = core::mul_add(alpha * start_distance_, start_distance_, rho);
    return {core::make_vector<unknowns>([&](auto i) { return i < Positions ? Real(2.0) * p[i < 3 ? i : 0] : alpha; }),
            core::dot(p, p) - rho};
  }
  /// How large the numbers are whose difference row j of the lifted equation is.
  Vector lifted_size(std::size_t j) const {
    const core::Vector3<Real> p = point(j);
    return core::make_vector<unknowns>([&](auto i) {
      if constexpr (i < Positions) return Real(2.0) * (core::abs(p[i]) + core::abs(start_position_[i]));
      return core::abs(load(problems_.alpha(j)));
    });
  }
  Vector unlifted(const Vector& y) const {
    core::Vector3<Real> at = start_position_;
    core::unroll<Positions>([&](auto i) { at[i] = at[i] + y[i]; });
    return given(at, FreeDistance ? core::sqrt(y[unknowns - 1]) : start_distance_);
  }
  core::Mask<Real> possible(const Vector& y) const {
    return !FreeDistance ? y[0] <= y[0] : y[unknowns - 1] > Real(0.0);
  }

  Real squared_move(const Vector& du) const {
    Real sum(0.0);
    core::unroll<Positions>([&](auto i) {
      const Real move = du[i] * inverse_scale_[i];
      sum = core::mul_add(move, move, sum);
    });
    return sum;
  }

  core::Mask<Real> in_domain(const Vector& u) const {
    const Real v = image_distance(u);
    core::Mask<Real> inside = Real(0.0) <= Real(1.0);
    for (std::size_t j = 0; j < points(); ++j) {
      // What is not a number is no matter of the domain.
      inside = inside & !(core::mul_add(load(problems_.alpha(j)) * v, v, load(problems_.measured(j))) <= Real(0.0));
    }
    return inside;
  }

  /// The prior on v as one observation (v - v_start) of weight sigma_prior^2 / (0.005 v_start)^2 beside ranges of
  /// weight 1; `factor` is what ranges with small residuals weigh.
  void add_prior(const Vector& u, double factor, NormalEquations<Real, unknowns>& equations) const {
    if constexpr (FreeDistance) {
      if (!has_prior()) return;
      constexpr std::size_t last = unknowns - 1;
      const Real weighted = Real(factor) * prior_weight_ * inverse_scale_[last];
      equations.matrix(last, last) = core::mul_add(weighted, inverse_scale_[last], equations.matrix(last, last));
      equations.gradient[last] = core::mul_add(weighted, image_distance(u) - start_distance_, equations.gradient[last]);
    }
  }

  /// How much the step u <- u - du changes the squared and weighted residual of the prior.
  Real prior_change(const Vector& u, const Vector& du) const {
    if (!has_prior()) return Real(0.0);
    const Real change = -du[unknowns - 1] * inverse_scale_[unknowns - 1];
    const Real before = image_distance(u) - start_distance_;
    return prior_weight_ * change * core::mul_add(Real(2.0), before, change);
  }

  Real prior_squares(const Vector& u) const {
    const Real error = image_distance(u) - start_distance_;
    return has_prior() ? prior_weight_ * error * error : Real(0.0);
  }
  std::size_t observations() const { return points() + (has_prior() ? 1 : 0); }

 private:
  bool has_prior() const { return FreeDistance && options_.v_mode == VMode::Prior; }
  Real load(std::span<const double> column) const { return core::load<Real>(column.data() + slot_); }
  core::Vector3<Real> point(std::size_t j) const {
    return {load(problems_.position(j, 0)), load(problems_.position(j, 1)), load(problems_.position(j, 2))};
  }

  void scale_columns() {
    Vector squares = core::make_vector<unknowns>([](auto) { return Real(0.0); });
    const Vector at = start();
    for (std::size_t j = 0; j < points(); ++j) {
      const auto o = observe(j, at);
      core::unroll<unknowns>([&](auto i) { squares[i] = core::mul_add(o.row[i], o.row[i], squares[i]); });
    }
    core::unroll<unknowns>([&](auto i) {
      const Real zero(0.0);
      const auto [norm, inverse] = core::root_and_inverse(squares[i]);
      scale_[i] = core::select(squares[i] > zero, norm, Real(1.0));
      inverse_scale_[i] = core::select(squares[i] > zero, inverse, Real(1.0));
    });
  }

  const core::ProblemBatch& problems_;
  std::size_t slot_;
  const SolverOptions& options_;
  core::Vector3<Real> start_position_;
  Real start_distance_;
  Real prior_weight_{0.0};
  Vector scale_;
  Vector inverse_scale_;
};

}  // namespace ridgeloc::solvers
