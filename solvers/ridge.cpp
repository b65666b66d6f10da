#include "solvers/ridge.hpp"

#include "solvers/iteration.hpp"
#include "solvers/k_registry.hpp"
#include "solvers/least_squares.hpp"

namespace ridgeloc::solvers {

namespace {

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
  Step<Real> step(const RangeModel<Real>& model, const core::Vector3<Real>& x, int iteration, core::Index<Real> trial,
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
    core::Mask<Real> singular = x[0] != x[0];
    with_k_estimator(options.k, [&](const auto& estimator) {
      if constexpr (estimator.needs_ols_step) {
        const core::LinearSolution<Real> ols = core::solve(least_squares.matrix, least_squares.gradient);
        context.ols_step = ols.x;
        context.sigma2 =
            weighted_squares(model, core::subtract(x, ols.x)) / Real(static_cast<double>(model.points()));
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

}  // namespace

void solve_rr(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
              core::SolutionBatch& out) {
  solve_batch(Ridge{options, oracle, false}, problems, options, oracle, out);
}

void solve_rrr(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
               core::SolutionBatch& out) {
  solve_batch(Ridge{options, oracle, true}, problems, options, oracle, out);
}

}  // namespace ridgeloc::solvers
