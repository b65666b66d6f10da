#pragma once

#include "solvers/iteration.hpp"
#include "solvers/k_registry.hpp"
#include "solvers/least_squares.hpp"

namespace ridgeloc::solvers {

/// Ridge regression, and robust ridge regression where `robust` is set: dx = (J'WJ + K)^-1 J'We with K from `options.k`
/// at every iteration (RRR paper, eqs. 10, 12, 13, 14).
///
/// W is diag(s^2), or the robust weights of weight.hpp at x_k. An estimator of K that learns from the data gets one
/// least-squares step dx_ls at x_k, with W = diag(s^2) in either case, and sigma2 = e'We / n at x_k - dx_ls.
struct Ridge {
  const SolverOptions& options;
  const core::Oracle* oracle;
  bool robust;

  static constexpr bool has_k = true;
  template <class Real>
  struct Memory {};

  template <class Real>
  Real weight(Real score, Real residual, std::size_t points) const {
    return robust ? robust_weight(score, residual, points, options.theta_m) : score_weight(score);
  }

  template <class Real>
  Step<Real> step(const RangeModel<Real>& model, const core::Vector3<Real>& x, Real iteration, core::Index<Real> trial,
                  Memory<Real>&) const {
    NormalEquations<Real> least_squares;
    NormalEquations<Real> weighted;
    for (std::size_t j = 0; j < model.points(); ++j) {
      const RangeObservation<Real> o = model.observe(j, x);
      const Real score = model.score(j);
      least_squares.add(o, score_weight(score));
      if (robust) weighted.add(o, weight(score, o.residual, model.points()));
    }

    KContext<Real> context{{}, Real(0.0), x, iteration, trial, oracle, options};
    core::Vector3<Real> k{};
    core::Mask<Real> singular = iteration < Real(0.0);  // in no lane
    with_k_estimator(options.k, [&](const auto& estimator) {
      if constexpr (estimator.needs_ols_step) {
        const core::LinearSolution<Real> ols = core::solve(least_squares.matrix, least_squares.gradient);
        context.ols_step = ols.x;
        context.sigma2 = weighted_squares(model, core::subtract(x, ols.x)) / Real(static_cast<double>(model.points()));
        singular = ols.singular;
      }
      k = estimator(context);
    });

    const NormalEquations<Real>& equations = robust ? weighted : least_squares;
    const core::LinearSolution<Real> solution =
        core::solve(core::add_diagonal(equations.matrix, k), equations.gradient);
    singular = singular | solution.singular;
    return {solution.x, singular, !singular, k};
  }
};

}  // namespace ridgeloc::solvers
