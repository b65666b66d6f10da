// A solver as a value: a plain function, or one that is called with state.

#include "solvers/solver.hpp"

#include <type_traits>

#include "core/status.hpp"
#include "solvers/reference/reference_objective.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hand_scene.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;
using solvers::Objective;
using solvers::ReferenceLoss;
using solvers::Solver;
using solvers::SolverOptions;

namespace {

/// Answers every problem with one place, as a table or a model that was read from a file would.
struct KnownPlace {
  Point place;

  void operator()(const core::ProblemBatch& problems, const SolverOptions&, const core::Oracle*,
                  core::SolutionBatch& out) const {
    out.reshape(problems.trials());
    for (std::size_t t = 0; t < problems.trials(); ++t) {
      for (std::size_t axis = 0; axis < 3; ++axis) out.estimate[axis][t] = place[axis];
      out.status[t] = static_cast<std::uint8_t>(core::Status::Converged);
    }
  }
};

void answer_origin(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
                   core::SolutionBatch& out) {
  KnownPlace{{0, 0, 0}}(problems, options, oracle, out);
}

void keep_all(SolverOptions&) {}
Objective nothing(const SolverOptions&) {
  return Objective::none("answers what it was told");
}

/// Registered by hand, for every instruction set.
solvers::SolverEntry entry_of(Solver solver) {
  return {.name = "known",
          .summary = "one place",
          .options = {},
          .has_k = false,
          .is_least_squares = false,
          .adjust = keep_all,
          .objective = nothing,
          .solve = solver,
          .kernels = {solver, solver, solver}};
}

template <class State>
concept IsState = requires(State&& state) {
  Solver::with_state(std::forward<State>(state));
};

}  // namespace

// A value that nothing needs to be done for when it is copied or dropped, and no state that is gone after the line.
static_assert(std::is_trivially_copyable_v<Solver> && std::is_trivially_destructible_v<Solver>);
static_assert(sizeof(Solver) <= 3 * sizeof(void*));
static_assert(IsState<const KnownPlace&> && IsState<KnownPlace&>);
static_assert(!IsState<KnownPlace> && !IsState<const KnownPlace>);
static_assert(!IsState<const Point&>);

TEST_CASE("a solver is called with its own state") {
  const KnownPlace here{{1, 2, 3}};
  const KnownPlace there{{4, 5, 6}};
  const auto first = entry_of(Solver::with_state(here));
  const auto second = entry_of(Solver::with_state(there));
  const auto problems = axes_problem(0.1, -0.2, 0.3);
  core::SolutionBatch out;
  first.solve(problems, {}, nullptr, out);
  CHECK(estimate(out) == here.place);
  second.solve(problems, {}, nullptr, out);
  CHECK(estimate(out) == there.place);
  const Solver copy = first.kernel(core::Isa::Avx2);
  copy(problems, {}, nullptr, out);
  CHECK(estimate(out) == here.place);
  CHECK(status(out) == core::Status::Converged);
}

TEST_CASE("a plain function is a solver, and so is one from the registry with something done around it") {
  const auto problems = axes_problem(0.1, -0.2, 0.3);
  core::SolutionBatch out;
  entry_of(answer_origin).solve(problems, {}, nullptr, out);
  CHECK(estimate(out) == Point{0, 0, 0});

  int calls = 0;
  const auto counted = [&calls, inner = solvers::solver_named("ols").solve](
                           const core::ProblemBatch& batch, const SolverOptions& options, const core::Oracle* oracle,
                           core::SolutionBatch& solutions) {
    ++calls;
    inner(batch, options, oracle, solutions);
  };
  const Solver solver = Solver::with_state(counted);
  solver(problems, steps(1), nullptr, out);
  solver(problems, steps(1), nullptr, out);
  CHECK(calls == 2);
  CHECK(estimate(out) == estimate(solve("ols", problems, steps(1))));
}

TEST_CASE("kernels that cannot run are none") {
  CHECK_FALSE(Solver());
  CHECK_FALSE(Solver(nullptr));
  CHECK(Solver(answer_origin));
  const KnownPlace here{{1, 2, 3}};
  CHECK(Solver::with_state(here));
  for (const solvers::SolverEntry& entry : solvers::solver_registry()) {
    CHECK(entry.solve);
    for (std::size_t i = 0; i < core::isa_count; ++i) {
      const auto isa = static_cast<core::Isa>(i);
      CHECK(static_cast<bool>(entry.kernel(isa)) == core::is_supported(isa));
    }
  }
}

TEST_CASE("the reference goes by what an entry says, whatever its name") {
  const KnownPlace here{{1, 2, 3}};
  auto entry = entry_of(Solver::with_state(here));
  entry.name = "ols";
  CHECK_FALSE(solvers::reference_objective(entry, {}));
  entry.objective = [](const SolverOptions&) { return Objective(ReferenceLoss::HuberTheta).not_binding(); };
  entry.adjust = [](SolverOptions& options) { options.theta_m = 0.25; };
  const auto objective = solvers::reference_objective(entry, {});
  REQUIRE(objective);
  CHECK(objective->loss == ReferenceLoss::HuberTheta);
  CHECK(objective->theta_m == 0.25);
  CHECK_FALSE(objective->binding);
}
