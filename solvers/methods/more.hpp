#pragma once

#include <cstddef>

#include "solvers/methods/step.hpp"
#include "solvers/models/least_squares.hpp"
#include "solvers/models/weight.hpp"

namespace ridgeloc::solvers {

/// Levenberg-Marquardt with the trust region of MINPACK's lmder (More 1978): the step minimises the linearised cost
/// within |D dx| <= delta, D_i the largest norm that column i of sqrt(W) J had so far. delta begins with 100 |D x| and
/// follows the ratio of actual to predicted reduction: below 1/4 it shrinks, from 3/4 on it becomes 2 |D dx|; below
/// 1e-4 the step is rejected. W = diag(s^2).
struct More : MethodDefaults {
  /// delta, the damping mu, whether a step has been accepted yet, D^2.
  template <std::size_t P>
  static constexpr std::size_t memory_size = P + 3;

  const SolverOptions& options;

  explicit More(const SolverOptions& o) : options(o) {}

  template <class Model, class Vector>
  ScoreWeights weights(const Model&, const Vector&) const {
    return ScoreWeights(options);
  }

  template <class Model, class Vector, class Real, class Oracle>
  Step<Real, Model::unknowns> step(const Model& model, const Vector& u, const Real& iteration, const Oracle*,
                                   Memory<Real, Model::unknowns + 3>& memory) const {
    using core::select;
    constexpr std::size_t P = Model::unknowns;
    const Real zero(0.0);
    const Real one(1.0);
    const ScoreWeights weigh(options);
    const auto equations = normal_equations(model, u, weigh);
    const Real cost = weighted_squares(model, u, weigh);

    const core::Mask<Real> first = iteration < Real(0.5);
    const Vector squared_scale = core::make_vector<P>([&](auto i) {
      const Real norm = equations.matrix(i, i);
      const Real before = select(first, select(norm > zero, norm, one), memory[3 + i]);
      return core::max(before, norm);
    });
    const auto scaled_length = [&](const Vector& a) {
      Real sum = zero;
      core::unroll<P>([&](auto i) { sum = core::mul_add(squared_scale[i] * a[i], a[i], sum); });
      return core::sqrt(sum);
    };
    const Real reach = Real(100.0) * scaled_length(u);
    Real delta = select(first, select(reach > zero, reach, Real(100.0)), memory[0]);

    const Damping<Real, P> damping =
        damping_for(equations, model.observations(), squared_scale, scaled_length, delta, memory[1]);
    const Real length = scaled_length(damping.du);
    const core::Mask<Real> unmoved = memory[2] < Real(0.5);
    delta = select(unmoved & (length < delta), length, delta);

    // Reductions are relative to the cost: predicted |J dx|^2 + 2 mu |D dx|^2, actual by differences of residuals.
    const Real inverse_cost = core::reciprocal(cost);
    const Real linear = core::dot(damping.du, core::multiply(equations.matrix, damping.du)) * inverse_cost;
    const Real damped = damping.mu * length * length * inverse_cost;
    const Real predicted = core::mul_add(Real(2.0), damped, linear);
    const Real slope = -(linear + damped);
    const Real actual = -weighted_squares_change(model, u, damping.du, weigh) * inverse_cost;
    const Real ratio = select(predicted > zero, actual * core::reciprocal(predicted), zero);

    const core::Mask<Real> poor = ratio <= Real(0.25);
    const core::Mask<Real> good = (!poor) & ((Real(0.75) <= ratio) | (damping.mu <= zero));
    const Real parabola = Real(0.5) * slope * core::reciprocal(core::mul_add(Real(0.5), actual, slope));
    Real shrink = select(actual < zero, parabola, Real(0.5));
    shrink = select(((actual <= Real(-99.0)) | (shrink < Real(0.1))), Real(0.1), shrink);
    const Real ten_steps = Real(10.0) * length;
    const Real shorter = shrink * select(delta < ten_steps, delta, ten_steps);
    delta = select(poor, shorter, select(good, Real(2.0) * length, delta));
    const Real mu =
        select(poor, damping.mu * core::reciprocal(shrink), select(good, Real(0.5) * damping.mu, damping.mu));

    memory[0] = delta;
    memory[1] = mu;
    core::unroll<P>([&](auto i) { memory[3 + i] = squared_scale[i]; });
    // At a minimum nothing can be gained any more and the ratio means nothing: steps that are lost in rounding pass. A
    // comparison with NaN is false, so a step that is not a number passes too, and ends as "non_finite".
    const core::Mask<Real> rejected = (ratio < Real(1e-4)) & (predicted > Real(1e-15));
    memory[2] = select(rejected, memory[2], one);
    return unless<Real>(rejected, damping.du, damping.singular);
  }

 private:
  template <class Real, std::size_t P>
  struct Damping {
    core::Vector<Real, P> du;
    Real mu;
    core::Mask<Real> singular;
  };

  /// MINPACK's lmpar: mu such that |D du| is within a tenth of delta, or 0 if the Gauss-Newton step is short enough; at
  /// most ten Newton steps on 1 / |D du|, held within bounds. Where J'WJ is singular, lmpar takes the basic solution of
  /// its pivoted QR for the Gauss-Newton step; there is none here, and the search begins at a thousandth of the bound.
  template <class Real, std::size_t P, class Length>
  static Damping<Real, P> damping_for(const NormalEquations<Real, P>& equations, std::size_t observations,
                                      const core::Vector<Real, P>& squared_scale, const Length& scaled_length,
                                      const Real& delta, const Real& previous) {
    using core::select;
    constexpr int most_steps = 10;
    const Real zero(0.0);
    const auto damped = [&](const Real& mu) {
      return core::add_diagonal(equations.matrix, core::scale(mu, squared_scale));
    };
    // The Newton step from mu, where du has the length delta + excess. The derivative of |D du| by mu is -|D du| q,
    // q = z'(H + mu D^2)^-1 z, z = D^2 du / |D du|.
    const auto newton = [&](const auto& matrix, const auto& du, const Real& length, const Real& excess) {
      const Real inverse_length = core::reciprocal(length);
      const auto z = core::make_vector<P>([&](auto k) { return squared_scale[k] * du[k] * inverse_length; });
      return excess * core::reciprocal(delta * core::dot(z, core::solve(matrix, z).x));
    };
    const auto undamped = core::solve(equations.matrix, equations.gradient, observations);
    const Real undamped_length = scaled_length(undamped.x);
    const Real undamped_excess = undamped_length - delta;
    const Real tolerance = Real(0.1) * delta;
    const core::Mask<Real> enough = (!undamped.singular) & (undamped_excess <= tolerance);
    Damping<Real, P> out{undamped.x, zero, none<Real>()};
    core::Mask<Real> searching = !enough;
    if (!core::any(searching)) return out;

    Real gradient_length = zero;
    core::unroll<P>([&](auto i) {
      gradient_length = core::mul_add(equations.gradient[i] * core::reciprocal(squared_scale[i]), equations.gradient[i],
                                      gradient_length);
    });
    gradient_length = core::sqrt(gradient_length);
    Real lower =
        select(undamped.singular, zero, newton(equations.matrix, undamped.x, undamped_length, undamped_excess));
    Real upper = gradient_length * core::reciprocal(delta);
    Real mu = core::max(previous, lower);
    mu = select(upper < mu, upper, mu);
    const Real guess =
        select(undamped.singular, Real(1e-3) * upper, gradient_length * core::reciprocal(undamped_length));
    mu = select(mu <= zero, guess, mu);
    Real excess_before = zero;
    for (int i = 0; i < most_steps && core::any(searching); ++i) {
      mu = select(mu <= zero, Real(1e-3) * upper, mu);
      const auto matrix = damped(mu);
      const auto solution = core::solve(matrix, equations.gradient, observations);
      const Real length = scaled_length(solution.x);
      const Real excess = length - delta;
      out.du = core::select<Real>(searching, solution.x, out.du);
      out.mu = select(searching, mu, out.mu);
      out.singular = (searching & solution.singular) | (out.singular & !searching);
      // Without a lower bound, less damping may no longer lengthen the step: the gradient has no part along what J'WJ
      // does not see.
      const core::Mask<Real> hopeless = (lower <= zero) & (excess <= excess_before) & (excess_before < zero);
      searching = searching & (core::abs(excess) > tolerance) & !hopeless;
      lower = select((excess > zero) & (mu > lower), mu, lower);
      upper = select((excess < zero) & (mu < upper), mu, upper);
      const Real next = mu + newton(matrix, solution.x, length, excess);
      mu = select(searching, core::max(lower, next), mu);
      excess_before = excess;
    }
    return out;
  }
};

}  // namespace ridgeloc::solvers
