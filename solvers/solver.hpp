#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "core/isa.hpp"
#include "core/problem.hpp"
#include "core/solution.hpp"
#include "solvers/objective.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// A solver without state.
using SolverFunction = void (*)(const core::ProblemBatch& problems, const SolverOptions& options,
                                const core::Oracle* oracle, core::SolutionBatch& out);

/// Solves every problem of a batch. The only contract a solver has: no logging, no exception, no allocation beyond
/// growing `out` and two buffers that each thread keeps (a queue of about 70 to 130 bytes for each trial of the largest
/// batch, and room for the weights of irls); a numerical failure is a status. `oracle` is null outside simulations.
/// Thread safe.
///
/// A function, or one that is called with state: a value of three pointers, called once a batch. It owns nothing. State
/// must outlive every copy of the solver, which for one in a registry means the program; it is constant, and the
/// threads of a run call it at once. Answers may depend on problems, options and oracle alone, or no result can be
/// computed again.
class Solver {
 public:
  /// None, for kernels that cannot run. May not be called.
  constexpr Solver() = default;
  constexpr Solver(SolverFunction function) : function_(function) {}

  /// Calls `state(problems, options, oracle, out)`.
  template <class State>
  requires std::invocable<const State&, const core::ProblemBatch&, const SolverOptions&, const core::Oracle*,
                          core::SolutionBatch&>
  static constexpr Solver with_state(const State& state) {
    return Solver(std::addressof(state),
                  [](const void* own, const core::ProblemBatch& problems, const SolverOptions& options,
                     const core::Oracle* oracle,
                     core::SolutionBatch& out) { (*static_cast<const State*>(own))(problems, options, oracle, out); });
  }
  template <class State>
  static Solver with_state(const State&&) = delete;  // would not live long enough

  explicit constexpr operator bool() const { return function_ != nullptr || stateful_ != nullptr; }

  void operator()(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
                  core::SolutionBatch& out) const {
    if (stateful_ != nullptr) {
      stateful_(state_, problems, options, oracle, out);
    } else {
      function_(problems, options, oracle, out);
    }
  }

 private:
  using StatefulFunction = void (*)(const void* state, const core::ProblemBatch& problems, const SolverOptions& options,
                                    const core::Oracle* oracle, core::SolutionBatch& out);

  constexpr Solver(const void* state, StatefulFunction function) : stateful_(function), state_(state) {}

  SolverFunction function_ = nullptr;
  StatefulFunction stateful_ = nullptr;
  const void* state_ = nullptr;
};

/// A solver as users see it, and all that others may know of it.
struct SolverEntry {
  std::string_view name;
  std::string_view summary;
  std::span<const std::string_view> options;  ///< names of the settings that it reads besides the common ones
  bool has_k;                                 ///< steps have a ridge parameter, so that similarities are recorded
  bool is_least_squares;                      ///< a converged estimate is the least-squares minimum, where it stops
  void (*adjust)(SolverOptions& options);     ///< fixes the settings that it does not leave to the user
  Objective (*objective)(const SolverOptions& adjusted);  ///< what it minimises
  Solver solve;                                           ///< in double, one trial at a time: the reference
  std::array<Solver, core::isa_count> kernels;            ///< several trials at a time; none where they cannot run

  Solver kernel(core::Isa isa) const { return kernels[static_cast<std::size_t>(isa)]; }
};

/// `geometry_of`, compiled for an instruction set. Precondition: core::is_supported(isa).
using GeometryKernel = void (*)(const core::ProblemBatch& problems, const SolverOptions& options,
                                const core::Oracle& oracle, std::span<double> gdop, std::span<double> condition);
GeometryKernel geometry_kernel(core::Isa isa);

/// All solvers, in the order in which `list` shows them.
std::span<const SolverEntry> solver_registry();

/// The solver of that name, or null.
const SolverEntry* find_solver(std::string_view name);

/// The solver of that name, which a study that was read has checked. Throws core::InputError where there is none.
const SolverEntry& solver_named(std::string_view name);

/// An estimator of the ridge parameter as users see it; its index is `SolverOptions::k`.
struct KEstimatorEntry {
  std::string_view name;
  std::string_view summary;
  bool needs_ols_step;
  bool needs_oracle;
};
std::span<const KEstimatorEntry> k_estimator_registry();

/// A robust weight of irls as users see it; its index is `SolverOptions::weight`.
struct WeightEntry {
  std::string_view name;
  std::string_view summary;
};
std::span<const WeightEntry> weight_registry();

/// Index of the estimator of that name.
std::optional<std::size_t> find_k_estimator(std::string_view name);

}  // namespace ridgeloc::solvers
