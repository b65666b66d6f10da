#pragma once

#include "solvers/iteration.hpp"
#include "solvers/least_squares.hpp"

namespace ridgeloc::solvers {

/// Levenberg-Marquardt with lazy damping: dx = (J'WJ + mu diag(J'WJ))^-1 J'We, W = diag(s^2).
///
/// mu is 0 until a step would make e'We grow. Such a step is rejected: x stays, mu becomes 1e-3 or ten times what it
/// was, the iteration counts and does not meet the stop rule. An accepted step divides mu by ten.
struct LazyLevenbergMarquardt {
  static constexpr bool has_k = false;
  static constexpr double first_damping = 1e-3;
  static constexpr double damping_factor = 10.0;

  template <class Real>
  struct Memory {
    Real damping{0.0};
  };

  template <class Real>
  Step<Real> step(const RangeModel<Real>& model, const core::Vector3<Real>& x, Real, core::Index<Real>,
                  Memory<Real>& memory) const {
    using core::select;
    const NormalEquations<Real> equations = least_squares_equations(model, x);
    const core::Symmetric3<Real>& a = equations.matrix;
    const Real mu = memory.damping;
    const core::LinearSolution<Real> solution =
        core::solve(core::add_diagonal(a, {mu * a.xx, mu * a.yy, mu * a.zz}), equations.gradient);

    // A comparison with NaN is false, so a step that is not a number is accepted and ends as "non_finite".
    const Real zero(0.0);
    const core::Mask<Real> rejected = weighted_squares_change(model, x, solution.x) > zero;
    const Real raised = select(mu > zero, mu * Real(damping_factor), Real(first_damping));
    memory.damping = select(rejected, raised, mu / Real(damping_factor));
    return {core::select<Real>(rejected, {zero, zero, zero}, solution.x), solution.singular, !rejected, {}};
  }

  template <class Real>
  Real weight(Real score, Real, std::size_t) const {
    return score_weight(score);
  }
};

}  // namespace ridgeloc::solvers
