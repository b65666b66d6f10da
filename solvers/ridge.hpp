#pragma once

#include "solvers/solver.hpp"

namespace ridgeloc::solvers {

/// Ridge regression: dx = (J'WJ + K)^-1 J'We, W = diag(s^2), K from `options.k` at every iteration (RRR paper, eqs. 10,
/// 12). An estimator of K that learns from the data gets one least-squares step dx_ls at x_k and
/// sigma2 = e'We / n at x_k - dx_ls.
void solve_rr(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
              core::SolutionBatch& out);

/// Robust ridge regression: the same with the robust weights w_i = s_i / max(theta, |e_i|) of weight.hpp at x_k (eqs.
/// 13, 14). K still comes from the least-squares step.
void solve_rrr(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
               core::SolutionBatch& out);

}  // namespace ridgeloc::solvers
