#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "core/matrix.hpp"
#include "core/problem.hpp"
#include "core/symmetric_eigen.hpp"
#include "solvers/methods/step.hpp"
#include "solvers/models/models.hpp"
#include "solvers/models/observation.hpp"

/// What the geometry of a problem says beforehand about any estimate, from J'J at the truth.
namespace ridgeloc::solvers {

namespace detail {

/// The largest root of x^3 - trace x^2 + minors x - determinant, whose roots are all real, by Laguerre's method from
/// above: it converges cubically, to a triple root too, and never passes the root.
template <class Real>
Real largest_root(const Real& trace, const Real& minors, const Real& determinant) {
  constexpr int steps = 5;
  const Real three(3.0);
  Real x = trace;
  for (int i = 0; i < steps; ++i) {
    const Real p = core::mul_add(core::mul_add(x - trace, x, minors), x, -determinant);
    const Real slope = core::mul_add(core::mul_add(three, x, Real(-2.0) * trace), x, minors);
    const Real curvature = core::mul_add(Real(6.0), x, Real(-2.0) * trace);
    const Real discriminant = Real(2.0) * core::mul_add(Real(2.0) * slope, slope, Real(-3.0) * p * curvature);
    const Real denominator = slope + core::sqrt(core::max(discriminant, Real(0.0)));
    x = x - core::select(denominator > Real(0.0), three * p * core::reciprocal(denominator), Real(0.0));
  }
  return x;
}

template <class Real>
struct Geometry {
  Real position_trace;  ///< of the part of (J'J)^-1 that belongs to coordinates
  Real condition;       ///< largest over smallest eigenvalue of J'J
  core::Mask<Real> singular;
};

template <class Real, std::size_t P>
Geometry<Real> geometry(const core::Symmetric<Real, P>& matrix, std::size_t positions, std::size_t observations) {
  if constexpr (P == 3) {
    if (positions == 3) {
      const core::Adjugate<Real> inverse = core::adjugate(matrix, observations);
      const Real trace = matrix(0, 0) + matrix(1, 1) + matrix(2, 2);
      const Real minors = inverse.matrix(0, 0) + inverse.matrix(1, 1) + inverse.matrix(2, 2);
      const Real reciprocal = core::reciprocal(inverse.determinant);
      const Real inverse_trace = minors * reciprocal;
      const Real largest = largest_root(trace, minors, inverse.determinant);
      const Real largest_of_inverse = largest_root(inverse_trace, trace * reciprocal, reciprocal);
      return {inverse_trace, largest * largest_of_inverse, inverse.singular};
    }
  }
  const auto eigen = core::symmetric_eigen(matrix);
  Real trace(0.0);
  Real least = eigen.values[0];
  Real most = eigen.values[0];
  core::Mask<Real> singular = none<Real>();
  for (std::size_t i = 0; i < positions; ++i) {
    core::Vector<Real, P> unit = every<P>(Real(0.0));
    unit[i] = Real(1.0);
    const auto column = core::solve(matrix, unit, observations);
    trace = trace + column.x[i];
    singular = column.singular;
  }
  core::unroll<P - 1>([&](auto i) {
    const Real value = eigen.values[i + 1];
    least = core::select(value < least, value, least);
    most = core::max(most, value);
  });
  return {trace, most * core::reciprocal(least), singular};
}

}  // namespace detail

/// Geometric dilution of precision of every problem at the truth, sqrt of the trace of the position's part of (J'J)^-1,
/// and the condition number of J'J; both infinite where J'J is singular. The Cramer-Rao bound of the position is range
/// sigma times the dilution: sqrt(tr F^-1) with F = J'J / sigma^2. A prior on the image
/// distance counts as an observation. Factors alpha and pseudoranges are taken as measured, noise included.
template <class Real = double>
[[gnu::flatten]] void geometry_of(const core::ProblemBatch& problems, const SolverOptions& options,
                                  const core::Oracle& oracle, std::span<double> gdop, std::span<double> condition) {
  SolverOptions unscaled = options;
  unscaled.column_scale = ColumnScale::None;
  unscaled.jacobian = Jacobian::Exact;
  unscaled.residual = Residual::Range;
  unscaled.sigma_prior_m = oracle.range_sigma_m;  // the bound knows the noise, whatever solvers assume
  with_model<Real, KernelSize::Wide>(problems, unscaled, [&]<class Model>(std::type_identity<Model>) {
    using Lanes = typename Model::Real;
    for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Lanes>) {
      const Model model(problems, slot, unscaled);
      const auto truth =
          core::make_vector<3>([&](auto axis) { return core::load_column<Lanes>(oracle.truth[axis], slot); });
      const auto u = model.given(truth, core::load_column<Lanes>(oracle.image_distance, slot));
      NormalEquations<Lanes, Model::unknowns> unweighted;
      for_each_point(
          model, [](auto j, const Model& m, const auto& at, auto& sum) { sum.add(m.observe(j, at), Lanes(1.0)); }, u,
          unweighted);
      model.add_prior(u, 1.0, unweighted);
      const auto of = detail::geometry(unweighted.matrix, Model::positions, model.observations());
      // Near singularity rounding can turn the trace of a positive definite inverse negative.
      const core::Mask<Lanes> regular = (of.position_trace > Lanes(0.0)) & !of.singular;
      const Lanes infinite(std::numeric_limits<double>::infinity());
      const Lanes dilution = core::sqrt(core::max(of.position_trace, Lanes(0.0)));
      core::store_column(gdop, slot, core::select(regular, dilution, infinite));
      core::store_column(condition, slot, core::select(regular, of.condition, infinite));
    }
  });
}

}  // namespace ridgeloc::solvers
