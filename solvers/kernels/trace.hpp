#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include "core/problem.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// What a solver proposes at an iterate.
struct TracedStep {
  double length_m = 0.0;     ///< |dx| of the position, of a rejected step too; NaN where a matrix is singular, so that
                             ///< there is no step
  bool is_rejected = false;  ///< it would have made matters worse: the solver stays where it is
  std::vector<double> k;     ///< the diagonal of K, in the unknowns that the solver scales; empty without a K
};

/// An iterate of a solver.
struct TracedIterate {
  std::array<double, core::position_parameters> position{};  ///< m
  double image_distance_mm = 0.0;                            ///< v of pseudoranges, known or not
  double residual_rms_m = 0.0;                               ///< sqrt(sum e_j^2 / n)
  std::vector<double> weights;                               ///< w_j of each point
  double condition = 0.0;          ///< of J'WJ, in the unknowns that the solver scales; infinite where it is singular
  std::optional<TracedStep> step;  ///< absent at an estimate that the last step has led to
};

/// Solves one trial over `double` and tells every iterate, from where the solver begins to its estimate: the last is,
/// bit for bit, what `SolverEntry::solve` answers.
///
/// Slow beside a solver, and allocates. Thread safe. Throws core::InputError where `solver_registry()` has no such
/// solver. Precondition: `trial` is a slot of the batch and, where there is one, of the oracle.
std::vector<TracedIterate> trace(std::string_view solver, const core::ProblemBatch& problems, std::size_t trial,
                                 const SolverOptions& options, const core::Oracle* oracle);

}  // namespace ridgeloc::solvers
