#pragma once

#include "solvers/solver.hpp"

namespace ridgeloc::solvers {

/// Ordinary least squares by Gauss-Newton: dx = (J'WJ)^-1 J'We, W = diag(s^2) (RRR paper, eqs. 5, 7, 9).
void solve_ols(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
               core::SolutionBatch& out);

}  // namespace ridgeloc::solvers
