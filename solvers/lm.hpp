#pragma once

#include "solvers/solver.hpp"

namespace ridgeloc::solvers {

/// Levenberg-Marquardt with lazy damping: dx = (J'WJ + mu diag(J'WJ))^-1 J'We, W = diag(s^2).
///
/// mu is 0 until a step would make e'We grow. Such a step is rejected: x stays, mu becomes 1e-3 or ten times what it
/// was, the iteration counts and does not meet the stop rule. An accepted step divides mu by ten.
void solve_lm(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
              core::SolutionBatch& out);

}  // namespace ridgeloc::solvers
