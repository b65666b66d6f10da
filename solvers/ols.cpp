#include "solvers/ols.hpp"

#include "solvers/iteration.hpp"
#include "solvers/least_squares.hpp"

namespace ridgeloc::solvers {

namespace {

struct Ols {
  static constexpr bool has_k = false;
  template <class Real>
  struct Memory {};

  template <class Real>
  Step<Real> step(const RangeModel<Real>& model, const core::Vector3<Real>& x, int, core::Index<Real>,
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

}  // namespace

void solve_ols(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
               core::SolutionBatch& out) {
  solve_batch(Ols{}, problems, options, oracle, out);
}

}  // namespace ridgeloc::solvers
