#include "solvers/kernels/trace.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/registry.hpp"
#include "core/symmetric_eigen.hpp"
#include "solvers/kernels/solve_batch.hpp"
#include "solvers/methods/methods.hpp"
#include "solvers/models/models.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::solvers {

namespace {

template <std::size_t P>
double condition_of(const core::Symmetric<double, P>& matrix) {
  const auto values = core::symmetric_eigen(matrix).values;
  const auto [least, most] = std::ranges::minmax(values);
  return least > 0.0 ? most / least : std::numeric_limits<double>::infinity();
}

template <class Method, class Model>
TracedIterate iterate_at(const Method& method, const Model& model, const typename Model::Vector& u) {
  TracedIterate iterate;
  iterate.position = model.position(u);
  iterate.image_distance_mm = model.image_distance(u);
  const auto weigh = method.weights(model, u);
  NormalEquations<double, Model::unknowns> equations;
  double squares = 0.0;
  for (std::size_t j = 0; j < model.points(); ++j) {
    const auto o = model.observe(j, u);
    const double weight = weigh(j, model.score(j), o.residual) * 1.0;  // a UnitScore as a number
    equations.add(o, weight);
    squares += o.residual * o.residual;
    iterate.weights.push_back(weight);
  }
  model.add_prior(u, weigh.largest(), equations);
  iterate.residual_rms_m = std::sqrt(squares * (1.0 / static_cast<double>(model.points())));
  iterate.condition = condition_of(equations.matrix);
  return iterate;
}

template <class Method, class Model, class Proposed>
TracedStep traced(const Model& model, const Proposed& step) {
  TracedStep out;
  out.is_rejected = !step.singular && !step.accepted;
  out.length_m = step.singular ? std::numeric_limits<double>::quiet_NaN()
                               : std::sqrt(model.squared_move(out.is_rejected ? step.proposed : step.du));
  if constexpr (Method::has_k) out.k.assign(step.k.begin(), step.k.end());
  return out;
}

/// `solve_one_by_one` for one trial, told step by step.
template <class Model, class Method>
std::vector<TracedIterate> trace_trial(const Method& method, const core::ProblemBatch& problems, std::size_t trial,
                                       const core::Oracle* oracle) {
  const Model model(problems, trial, method.options);
  TrialOracle<double, Model::unknowns> known;
  if (oracle != nullptr) known = oracle_of(model, *oracle, trial, oracle->first_trial + trial);
  const auto* const given = oracle != nullptr ? &known : nullptr;
  IterationState<double, Model::unknowns, Method::template memory_size<Model::unknowns>> state{
      first_iterate(model, method.options)};
  std::vector<TracedIterate> iterates;
  bool active = method.options.max_iterations > 0;
  bool moved = true;
  while (active) {
    iterates.push_back(iterate_at(method, model, state.u));
    auto memory = state.memory;
    iterates.back().step = traced<Method>(model, method.step(model, state.u, state.iterations, given, memory));
    const double before = state.iterations;
    active = advance(method, model, given, state, active);
    moved = state.iterations > before;
  }
  if (moved) iterates.push_back(iterate_at(method, model, state.u));
  return iterates;
}

using Tracer = std::vector<TracedIterate> (*)(const core::ProblemBatch&, std::size_t, const SolverOptions&,
                                              const core::Oracle*);

template <class Solver>
std::vector<TracedIterate> trace_solver(const core::ProblemBatch& problems, std::size_t trial,
                                        const SolverOptions& options, const core::Oracle* oracle) {
  SolverOptions own = options;
  Solver::adjust(own);
  std::vector<TracedIterate> iterates;
  core::with_type<typename Solver::Variants>(Solver::variant(own), [&]<class Method>(std::type_identity<Method>) {
    const Method method(own);
    with_model<double, Method::size>(problems, own, [&]<class Model>(std::type_identity<Model>) {
      iterates = trace_trial<Model>(method, problems, trial, oracle);
    });
  });
  return iterates;
}

/// In the order of `solver_registry()`.
constexpr auto tracers = []<std::size_t... I>(std::index_sequence<I...>) {
  return std::array<Tracer, sizeof...(I)>{trace_solver<std::tuple_element_t<I, Methods>>...};
}
(std::make_index_sequence<std::tuple_size_v<Methods>>{});

}  // namespace

std::vector<TracedIterate> trace(std::string_view solver, const core::ProblemBatch& problems, std::size_t trial,
                                 const SolverOptions& options, const core::Oracle* oracle) {
  const auto index = &solver_named(solver) - solver_registry().data();
  return tracers[static_cast<std::size_t>(index)](problems, trial, options, oracle);
}

}  // namespace ridgeloc::solvers
