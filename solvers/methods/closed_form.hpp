#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>

#include "core/matrix.hpp"
#include "solvers/methods/step.hpp"
#include "solvers/models/least_squares.hpp"
#include "solvers/models/observation.hpp"
#include "solvers/models/weight.hpp"
#include "solvers/objective.hpp"

/// Positions without iterating. With x counted from the start x_0 and q = |x|^2, an observation reads
///   2 p_i'x + alpha_i V = |p_i|^2 - rho_i + q,   V = v^2   (ranges: no V, rho_i = m_i^2),
/// which is linear in (x, V, q). Both forms are least squares in these, with weights s^2.
namespace ridgeloc::solvers {

/// A position found directly.
template <class Vector, class Mask>
struct ClosedForm {
  Vector u;
  Mask singular;
};

/// Least squares in the lifted unknowns: normal equations, and w times the squared size of what rows were computed
/// from.
template <class Model, class Real = typename Model::Real>
struct LiftedEquations {
  using Vector = typename Model::Vector;
  static constexpr std::size_t P = Model::unknowns;

  NormalEquations<Real, P> normal;
  Vector squared_size = every<P>(Real(0.0));

  void add(const Observation<Real, P>& line, const Vector& size, const Real& weight) {
    normal.add(line, weight);
    core::unroll<P>([&](auto i) { squared_size[i] = core::mul_add(weight * size[i], size[i], squared_size[i]); });
  }

  /// Whether a column of the rows is a combination of the others to rounding. Its squared distance from all of these is
  /// 1 / (G^-1)_ii, G the normal matrix. Rounding makes up to t G_ii of that when G is formed of n rows and factorized,
  /// and t^2 S_i when rows are, S_i the squared size of what they are differences of: of coordinates, and of a row and
  /// the mean of all. With P columns, both bounds hold for t = P^2 (n + 8) eps. What is not finite is not deficient.
  core::Mask<Real> is_rank_deficient(const core::Factorization<Real, P>& factorization, std::size_t n) const {
    const Real t(static_cast<double>(P * P * (n + 8)) * std::numeric_limits<double>::epsilon());
    const Vector inverse = core::inverse_diagonal(factorization);
    core::Mask<Real> deficient = none<Real>();
    core::unroll<P>([&](auto i) {
      const Real least = t * core::mul_add(t, squared_size[i], normal.matrix(i, i));
      deficient = deficient | (factorization.inverse_pivot[i] <= Real(0.0)) | (Real(1.0) <= inverse[i] * least);
    });
    return deficient & core::is_finite(sum(core::diagonal(normal.matrix)));
  }
};

/// q as one more unknown: linear least squares with an intercept, for n > p.
template <class Model, class Real = typename Model::Real>
[[gnu::noinline]] auto linear_form(const Model& model, const SolverOptions& options)
    -> ClosedForm<typename Model::Vector, core::Mask<Real>> {
  constexpr std::size_t P = Model::unknowns;
  const ScoreWeights weigh(options);
  const Real zero(0.0);
  // Means of rows and right sides; then least squares about them.
  Real total = zero;
  auto mean = every<P>(zero);
  Real mean_right = zero;
  for_each_point(model, [&](auto j, const auto&) {
    const auto line = model.lifted(j);
    const Real w = weigh(j, model.score(j), zero) * Real(1.0);  // a UnitScore as a number
    total = total + w;
    core::unroll<P>([&](auto i) { mean[i] = core::mul_add(w, line.row[i], mean[i]); });
    mean_right = core::mul_add(w, line.residual, mean_right);
  });
  const Real inverse = core::reciprocal(total);
  mean = core::scale(inverse, mean);
  mean_right = mean_right * inverse;
  LiftedEquations<Model> equations;
  for_each_point(model, [&](auto j, const auto&) {
    const auto line = model.lifted(j);
    equations.add({core::subtract(line.row, mean), line.residual - mean_right}, model.lifted_size(j),
                  weigh(j, model.score(j), zero) * Real(1.0));
  });
  const auto factorization = core::factorize(equations.normal.matrix);
  return {model.unlifted(core::solve(factorization, equations.normal.gradient)),
          equations.is_rank_deficient(factorization, model.points())};
}

/// q as a known number, which makes (x, V) linear in it, and then the root of |x(q)|^2 = q (after Bancroft 1985), for
/// n >= p. Of two roots, V > 0 permitting, that of smaller squared residuals for n > p; for n = p, where both fit, that
/// nearer to the start. Where both are complex, noise has left no solution, and their real part is the answer.
template <class Model, class Real = typename Model::Real>
[[gnu::noinline]] auto bancroft_form(const Model& model, const SolverOptions& options)
    -> ClosedForm<typename Model::Vector, core::Mask<Real>> {
  constexpr std::size_t P = Model::unknowns;
  const ScoreWeights weigh(options);
  const Real zero(0.0);
  LiftedEquations<Model> equations;
  auto ones = every<P>(zero);  // the right side of a 1 in every observation: what q is multiplied with
  for_each_point(model, [&](auto j, const auto&) {
    const auto line = model.lifted(j);
    const Real w = weigh(j, model.score(j), zero) * Real(1.0);
    equations.add(line, model.lifted_size(j), w);
    core::unroll<P>([&](auto i) { ones[i] = core::mul_add(w, line.row[i], ones[i]); });
  });
  const auto factorization = core::factorize(equations.normal.matrix);
  const auto constant = core::solve(factorization, equations.normal.gradient);
  const auto slope = core::solve(factorization, ones);

  // |f + q g|^2 = q over the coordinates: a q^2 + 2 b q + c = 0.
  Real a = zero;
  Real b(-0.5);
  Real c = zero;
  core::unroll<Model::positions>([&](auto i) {
    a = core::mul_add(slope[i], slope[i], a);
    b = core::mul_add(slope[i], constant[i], b);
    c = core::mul_add(constant[i], constant[i], c);
  });
  const Real discriminant = core::neg_mul_add(a, c, b * b);
  const Real root = core::sqrt(core::max(discriminant, zero));
  // Stable for either sign of b: the root of larger size first, the other from their product.
  const Real larger = -(b + core::select(b < zero, -root, root));
  const Real from_product = c * core::reciprocal(larger);
  const Real one_of = core::select(a > zero, larger * core::reciprocal(a), from_product);
  const Real other = core::select(discriminant < zero, one_of, from_product);
  const auto at = [&](const Real& q) {
    return core::make_vector<P>([&](auto i) { return core::mul_add(q, slope[i], constant[i]); });
  };
  const auto first = at(other);
  const auto second = at(one_of);
  const auto first_u = model.unlifted(first);
  const auto second_u = model.unlifted(second);
  const bool exact = model.points() == P;
  const Real first_cost = exact ? other : weighted_squares(model, first_u, weigh);
  const Real second_cost = exact ? one_of : weighted_squares(model, second_u, weigh);
  // Costs that are not numbers, those of an impossible V, lose.
  const core::Mask<Real> take_second =
      ((second_cost < first_cost) | !(first_cost <= first_cost) | !model.possible(first)) &
      ((second_cost <= second_cost) & model.possible(second));
  return {core::select<Real>(take_second, second_u, first_u),
          equations.is_rank_deficient(factorization, model.points())};
}

/// One of the closed forms as a solver: its one step goes from the start to the solution.
template <bool bancroft>
struct Direct : MethodDefaults {
  static constexpr bool is_direct = true;

  const SolverOptions& options;

  explicit Direct(const SolverOptions& o) : options(o) {}

  template <class Model, class Vector>
  ScoreWeights weights(const Model&, const Vector&) const {
    return ScoreWeights(options);
  }

  template <class Model, class Vector, class Real, class Oracle, class Memory>
  Step<Real, Model::unknowns> step(const Model& model, const Vector& u, const Real&, const Oracle*, Memory&) const {
    const auto found = [&] {
      if constexpr (bancroft) {
        return bancroft_form(model, options);
      } else {
        return linear_form(model, options);
      }
    }();
    return {core::subtract(u, found.u), found.singular, !found.singular, {}};
  }
};

struct Linear : SingleVariant<Direct<false>> {
  static constexpr std::string_view name = "linear";
  static constexpr std::string_view summary = "closed form: lifted linear least squares, needs n > p";
  static constexpr std::array<std::string_view, 0> option_names{};
  static constexpr bool is_least_squares = false;
  static Objective objective(const SolverOptions&) { return Objective::none("least squares in (x, V, q), not in x"); }
};

struct Bancroft : SingleVariant<Direct<true>> {
  static constexpr std::string_view name = "bancroft";
  static constexpr std::string_view summary = "closed form: Bancroft's quadratic";
  static constexpr std::array<std::string_view, 0> option_names{};
  static constexpr bool is_least_squares = false;
  static Objective objective(const SolverOptions&) {
    return Objective::none("a root of the equations that least squares in (x, V) leaves");
  }
};

}  // namespace ridgeloc::solvers
