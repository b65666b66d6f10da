#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/matrix.hpp"
#include "core/problem.hpp"
#include "core/solution.hpp"
#include "core/status.hpp"
#include "solvers/estimators/true_k.hpp"
#include "solvers/methods/closed_form.hpp"
#include "solvers/methods/step.hpp"
#include "solvers/models/least_squares.hpp"

/// One iteration x <- x - dx of any method, and what is recorded of it.
namespace ridgeloc::solvers {

/// Positions further out than this (m) have left the domain of the model.
inline constexpr double domain_radius_m = 1e6;

/// Where the trials in the lanes stand. Lanes need not be at the same iteration.
template <class Real, std::size_t P, std::size_t MemorySize>
struct IterationState {
  core::Vector<Real, P> u;
  Real iterations{0.0};
  Real status{static_cast<double>(core::Status::IterationLimit)};
  Real eta_first{std::numeric_limits<double>::quiet_NaN()};
  Real eta_last{std::numeric_limits<double>::quiet_NaN()};
  Real eta_sum{std::numeric_limits<double>::quiet_NaN()};
  Memory<Real, MemorySize> memory = [] {
    Memory<Real, MemorySize> zeros;
    zeros.fill(Real(0.0));
    return zeros;
  }();

  static constexpr std::size_t values = P + 5 + MemorySize;

  /// Calls f with every value.
  template <class F>
  void for_each_value(F f) {
    for (Real& unknown : u) f(unknown);
    f(iterations);
    f(status);
    f(eta_first);
    f(eta_last);
    f(eta_sum);
    for (Real& value : memory) f(value);
  }
};

/// What the study knows about the trials in the slots slot, slot + 1, ..., which are numbered `trial`.
template <class Model, class Real = typename Model::Real>
TrialOracle<Real, Model::unknowns> oracle_of(const Model& model, const core::Oracle& oracle, std::size_t slot,
                                             const core::Words<Real>& trial) {
  const auto truth = core::make_vector<3>([&](auto axis) { return core::load_column<Real>(oracle.truth[axis], slot); });
  return {model.given(truth, core::load_column<Real>(oracle.image_distance, slot)),
          Real(oracle.range_sigma_m * oracle.range_sigma_m), oracle.k_error, trial};
}

/// The closed form that `options.start` names, or the given start where that has no answer. Not inlined: all methods
/// share it, and compilers need long for it.
template <class Model, class Real = typename Model::Real>
[[gnu::noinline]] typename Model::Vector closed_form_start(const Model& model, const SolverOptions& options) {
  const auto found = options.start == Start::Linear ? linear_form(model, options) : bancroft_form(model, options);
  return core::select<Real>((!found.singular) & core::is_finite(core::dot(found.u, found.u)), found.u, model.start());
}

/// Where a method begins.
template <class Model>
typename Model::Vector first_iterate(const Model& model, const SolverOptions& options) {
  return options.start == Start::Given ? model.start() : closed_form_start(model, options);
}

/// Takes one step in every active lane and returns which lanes go on.
template <class Method, class Model, class State, class Real = typename Model::Real>
[[gnu::flatten]] core::Mask<Real> advance(const Method& method, const Model& model,
                                          const TrialOracle<Real, Model::unknowns>* oracle, State& state,
                                          const core::Mask<Real>& active) {
  using core::select;
  using Mask = core::Mask<Real>;
  const SolverOptions& options = method.options;
  const auto code = [](core::Status status) { return Real(static_cast<double>(status)); };

  const auto step = method.step(model, state.u, state.iterations, oracle, state.memory);
  const typename Model::Vector next = core::subtract(state.u, step.du);
  const core::Vector3<Real> position = model.position(next);
  const Real distance = core::dot(position, position);
  const Real length = model.squared_move(step.du);
  Mask finite = core::is_finite(length) & core::is_finite(distance);
  if constexpr (Model::unknowns > Model::positions) finite = finite & core::is_finite(next[Model::positions]);
  const Mask moved = active & !step.singular & finite;
  Mask left = moved & (distance > Real(domain_radius_m * domain_radius_m));
  if constexpr (!Model::always_in_domain) {
    left = left | (moved & !model.in_domain(next)) | (active & !model.in_domain(state.u));
  }
  Mask converged = moved & !left & step.accepted;
  if constexpr (!Method::is_direct) {
    converged = converged & (length < Real(options.step_tolerance_m * options.step_tolerance_m));
  }

  if constexpr (Method::has_k) {
    if (oracle != nullptr) {
      const Real eta = similarity(options.eta, step.k, true_k(options.k_true, state.u, *oracle));
      const Mask first = moved & (state.iterations < Real(0.5));
      state.eta_first = select(first, eta, state.eta_first);
      state.eta_last = select(moved, eta, state.eta_last);
      state.eta_sum = select(first, eta, select(moved, state.eta_sum + eta, state.eta_sum));
    }
  }
  state.u = core::select<Real>(moved, next, state.u);
  state.iterations = select(moved, state.iterations + Real(1.0), state.iterations);
  state.status = select(converged, code(core::Status::Converged), state.status);
  if (const Mask failed = (active & !moved) | left; core::any(failed)) {  // rare
    state.status = select(active & step.singular, code(core::Status::Singular), state.status);
    state.status = select(active & !step.singular & !finite, code(core::Status::NonFinite), state.status);
    state.status = select(left, code(core::Status::LeftDomain), state.status);
  }
  const Real limit(static_cast<double>(options.max_iterations) - 0.5);
  return moved & !left & !converged & (state.iterations < limit);
}

/// Residuals and the remaining step at the estimates of a finished batch, from slot `slot` on.
template <class Method, class Model, class Real = typename Model::Real>
[[gnu::flatten]] void evaluate_estimate(const Method& method, const Model& model, std::size_t slot,
                                        core::SolutionBatch& out) {
  const auto position = core::make_vector<3>([&](auto i) { return core::load_column<Real>(out.estimate[i], slot); });
  const auto u = model.given(position, core::load_column<Real>(out.image_distance_mm, slot));
  const auto weights = method.weights(model, u);
  NormalEquations<Real, Model::unknowns> equations;
  Real squares(0.0);
  for_each_point(
      model,
      [](auto j, const Model& m, const auto& at, const auto& weigh, auto& equation, Real& sum)
          __attribute__((always_inline)) {
            const auto o = m.observe(j, at);
            equation.add(o, weigh(j, m.score(j), o.residual));
            sum = core::mul_add(o.residual, o.residual, sum);
          },
      u, weights, equations, squares);
  model.add_prior(u, weights.largest(), equations);
  const auto rest = core::solve(equations.matrix, equations.gradient, model.observations());
  const Real remaining = core::select(rest.singular, Real(std::numeric_limits<double>::infinity()),
                                      core::sqrt(model.squared_move(rest.x)));
  const Real rms = core::sqrt(squares * Real(1.0 / static_cast<double>(model.points())));
  core::store_column<Real>(out.residual_rms_m, slot, rms);
  core::store_column<Real>(out.remaining_step_m, slot, remaining);
}

/// Writes where the trials in the slots slot, slot + 1, ... stand.
template <class Model, class State, class Real = typename Model::Real>
[[gnu::flatten]] void store_state(const Model& model, const State& state, std::size_t slot, core::SolutionBatch& out) {
  const core::Vector3<Real> position = model.position(state.u);
  for (std::size_t i = 0; i < 3; ++i) core::store_column<Real>(out.estimate[i], slot, position[i]);
  if constexpr (!Model::always_in_domain) {
    core::store_column<Real>(out.image_distance_mm, slot, model.image_distance(state.u));
  }
  core::store_column<Real>(std::span<std::uint8_t>(out.status), slot, state.status);
  core::store_column<Real>(out.iterations, slot, state.iterations);
  core::store_column<Real>(out.eta_first, slot, state.eta_first);
  core::store_column<Real>(out.eta_last, slot, state.eta_last);
  core::store_column<Real>(out.eta_mean, slot, state.eta_sum * core::reciprocal(state.iterations));
}

}  // namespace ridgeloc::solvers
