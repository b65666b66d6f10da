#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "solvers/methods/step.hpp"
#include "solvers/models/least_squares.hpp"
#include "solvers/models/weight.hpp"
#include "solvers/objective.hpp"

namespace ridgeloc::solvers {

/// Powell's dogleg (1970) on J'WJ dx = J'We, W = diag(s^2): within a radius delta the Gauss-Newton step; else along the
/// gradient to the minimum of the linearised cost and from there towards the Gauss-Newton step, as far as delta allows.
/// With r the ratio of actual to predicted reduction of e'We: where r < 1/4, delta becomes half of the shorter of delta
/// and |dx|; where r > 3/4, it becomes 3 |dx| if that is longer. A step that would make e'We grow is rejected: it
/// counts and does not meet the stop rule. Where J'WJ is singular the path ends on the gradient. Lengths are those of
/// the unknowns, which for pseudoranges are scaled and include the image distance where it is one.
struct TrustRegionDogleg : MethodDefaults {
  template <std::size_t P>
  static constexpr std::size_t memory_size = 1;  ///< delta

  const SolverOptions& options;

  explicit TrustRegionDogleg(const SolverOptions& o) : options(o) {}

  template <class Model, class Vector>
  ScoreWeights weights(const Model&, const Vector&) const {
    return ScoreWeights(options);
  }

  template <class Model, class Vector, class Real, class Oracle>
  Step<Real, Model::unknowns> step(const Model& model, const Vector& u, const Real& iteration, const Oracle*,
                                   Memory<Real, 1>& memory) const {
    using core::mul_add;
    using core::select;
    constexpr std::size_t P = Model::unknowns;
    const Real zero(0.0);
    const Real two(2.0);
    const ScoreWeights weigh(options);
    const auto equations = normal_equations(model, u, weigh);
    const Vector& g = equations.gradient;
    const Real delta = select(iteration < Real(0.5), Real(options.trust_radius_m), memory[0]);

    const auto newton = core::solve(equations.matrix, g, model.observations());
    const Real curvature = core::dot(g, core::multiply(equations.matrix, g));
    const Real squared_gradient = core::dot(g, g);
    const Vector cauchy =
        core::scale(select(curvature > zero, squared_gradient * core::reciprocal(curvature), zero), g);
    const Real newton_squared = core::dot(newton.x, newton.x);
    const Real cauchy_squared = core::dot(cauchy, cauchy);
    const Real delta_squared = delta * delta;

    // The point on the second leg at distance delta: cauchy + t (newton - cauchy) with a t^2 + 2 b t = c.
    const Vector leg = core::subtract(newton.x, cauchy);
    const Real a = core::dot(leg, leg);
    const Real b = core::dot(cauchy, leg);
    const Real c = core::max(delta_squared - cauchy_squared, zero);
    const Real root = core::sqrt(core::max(mul_add(b, b, a * c), zero));
    const Real denominator = b + root;
    const Real t = select(b > zero, c * core::reciprocal(denominator), (root - b) * core::reciprocal(a));
    const Vector on_leg = core::make_vector<P>([&](auto i) { return mul_add(t, leg[i], cauchy[i]); });
    const Real to_border = delta * core::root_and_inverse(cauchy_squared).inverse;
    const core::Mask<Real> short_cauchy = cauchy_squared < delta_squared;
    const Vector bounded = core::select<Real>(short_cauchy, core::select<Real>(newton.singular, cauchy, on_leg),
                                              core::scale(to_border, cauchy));
    const core::Mask<Real> inside = (!newton.singular) & (newton_squared <= delta_squared);
    const Vector du = core::select<Real>(inside, newton.x, bounded);

    const Real predicted = mul_add(two, core::dot(du, g), -core::dot(du, core::multiply(equations.matrix, du)));
    const Real change = weighted_squares_change(model, u, du, weigh);
    const Real actual = -change;
    const Real length = core::sqrt(core::dot(du, du));
    const core::Mask<Real> poor = actual < Real(0.25) * predicted;
    const core::Mask<Real> good = actual > Real(0.75) * predicted;
    const Real shrunk = Real(0.5) * select(delta < length, delta, length);
    memory[0] = select(poor, shrunk, select(good, core::max(delta, Real(3.0) * length), delta));
    // A comparison with NaN is false, so a step that is not a number is accepted and ends as "non_finite".
    const core::Mask<Real> rejected = change > zero;
    const core::Mask<Real> nowhere = newton.singular & (curvature <= zero);
    return unless<Real>(rejected, du, nowhere);
  }
};

struct Dogleg : SingleVariant<TrustRegionDogleg> {
  static constexpr std::string_view name = "dogleg";
  static constexpr std::string_view summary = "Powell's dogleg in a trust region";
  static constexpr std::array<std::string_view, 1> option_names = {"trust_radius_m"};
  static constexpr bool is_least_squares = true;
  static Objective objective(const SolverOptions&) { return ReferenceLoss::WeightedSquares; }
};

}  // namespace ridgeloc::solvers
