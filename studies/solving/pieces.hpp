#pragma once

#include "core/problem.hpp"
#include "core/solution.hpp"
#include "solvers/solver.hpp"
#include "studies/study/monitor.hpp"

namespace ridgeloc::studies {

/// Memory of `solve_in_pieces`, kept from call to call.
struct PieceMemory {
  core::ProblemBatch problems;
  core::SolutionBatch solutions;
};

/// Solves a batch, in pieces where its options let trials take long, so that the monitor is asked about once in a
/// second or once in the trials that a kernel takes together. The bits do not depend on the pieces, since those of a
/// trial do not depend on its neighbours. Returns false, and then `out` is of no use, if the monitor asked to stop.
[[nodiscard]] bool solve_in_pieces(solvers::Solver solver, const core::ProblemBatch& problems,
                                   const solvers::SolverOptions& options, const core::Oracle& oracle,
                                   core::SolutionBatch& out, PieceMemory& memory, const Monitor& monitor);

/// Trials of a piece: what is solved between two looks at the monitor.
std::size_t piece_trials(const solvers::SolverOptions& options, std::size_t points);

}  // namespace ridgeloc::studies
