#pragma once

#include "solvers/iteration.hpp"
#include "solvers/least_squares.hpp"

namespace ridgeloc::solvers {

/// Ordinary least squares by Gauss-Newton: dx = (J'WJ)^-1 J'We, W = diag(s^2) (RRR paper, eqs. 5, 7, 9).
struct Ols {
  static constexpr bool has_k = false;
  template <class Real>
  struct Memory {};

  template <class Real>
  Step<Real> step(const RangeModel<Real>& model, const core::Vector3<Real>& x, Real, core::Index<Real>,
                  Memory<Real>&) const {
    const NormalEquations<Real> equations = least_squares_equations(model, x);
    const core::LinearSolution<Real> solution = core::solve(equations.matrix, equations.gradient);
    return {solution.x, solution.singular, !solution.singular, {}};
  }

  template <class Real>
  Real weight(Real score, Real, std::size_t) const {
    return score_weight(score);
  }
};

}  // namespace ridgeloc::solvers
