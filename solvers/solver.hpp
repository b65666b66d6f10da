#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/problem.hpp"
#include "core/solution.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// Solves every problem of a batch. The only contract a solver has: no allocation beyond growing `out`, no logging, no
/// exception; a numerical failure is a status. `oracle` is null outside simulations. Thread safe: a solver has no
/// state.
using Solver = void (*)(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
                        core::SolutionBatch& out);

/// A solver as users see it.
struct SolverEntry {
  std::string_view name;
  std::string_view summary;
  std::vector<std::string_view> options;  ///< names of the settings that it reads besides the common ones
  Solver solve;
};

/// All solvers, in the order in which `list` shows them.
std::span<const SolverEntry> solver_registry();

/// The solver of that name, or null.
const SolverEntry* find_solver(std::string_view name);

/// An estimator of the ridge parameter as users see it; its index is `SolverOptions::k`.
struct KEstimatorEntry {
  std::string_view name;
  std::string_view summary;
  bool needs_oracle;
};
std::span<const KEstimatorEntry> k_estimator_registry();

/// Index of the estimator of that name.
std::optional<std::size_t> find_k_estimator(std::string_view name);

}  // namespace ridgeloc::solvers
