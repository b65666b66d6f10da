#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/matrix3.hpp"
#include "core/problem.hpp"
#include "core/solution.hpp"
#include "core/status.hpp"
#include "solvers/normal_equations.hpp"
#include "solvers/step.hpp"
#include "solvers/true_k.hpp"

/// One iteration x <- x - dx of any method, and what is recorded of it.
namespace ridgeloc::solvers {

/// Positions further out than this (m) have left the domain of the model.
inline constexpr double domain_radius_m = 1e6;

/// Where the trials in the lanes stand. Lanes need not be at the same iteration.
template <class Real, std::size_t MemorySize>
struct IterationState {
  core::Vector3<Real> x;
  Real iterations{0.0};
  Real status{static_cast<double>(core::Status::MaxIterations)};
  Real eta_first{std::numeric_limits<double>::quiet_NaN()};
  Real eta_last{std::numeric_limits<double>::quiet_NaN()};
  Real eta_sum{std::numeric_limits<double>::quiet_NaN()};
  Memory<Real, MemorySize> memory = [] {
    Memory<Real, MemorySize> zeros;
    zeros.fill(Real(0.0));
    return zeros;
  }();

  /// What `for_each_value` counts through, and where.
  enum Value : std::size_t { X, Iterations = 3, StatusCode, EtaFirst, EtaLast, EtaSum, FirstMemory };
  static constexpr std::size_t values = FirstMemory + MemorySize;

  /// Calls f with every value, in the order of `Value`.
  template <class F>
  void for_each_value(F f) {
    for (Real& coordinate : x) f(coordinate);
    f(iterations);
    f(status);
    f(eta_first);
    f(eta_last);
    f(eta_sum);
    for (Real& value : memory) f(value);
  }
};

/// What the study knows about the trials in the slots slot, slot + 1, ..., which are numbered `trial`.
template <class Real>
TrialOracle<Real> oracle_of(const core::Oracle& oracle, std::size_t slot, const core::Words<Real>& trial) {
  return {{core::load_column<Real>(oracle.truth[0], slot), core::load_column<Real>(oracle.truth[1], slot),
           core::load_column<Real>(oracle.truth[2], slot)},
          Real(oracle.range_sigma_m * oracle.range_sigma_m),
          oracle.k_error,
          trial};
}

/// Takes one step in every active lane and returns which lanes go on.
template <class Method, class Model, class State, class Real = typename Model::Real>
[[gnu::flatten]] core::Mask<Real> advance(const Method& method, const Model& model, const TrialOracle<Real>* oracle,
                                          State& state, const core::Mask<Real>& active) {
  using core::select;
  using Mask = core::Mask<Real>;
  const SolverOptions& options = method.options;
  const auto code = [](core::Status status) { return Real(static_cast<double>(status)); };

  const Step<Real> step = method.step(model, state.x, state.iterations, oracle, state.memory);
  const core::Vector3<Real> next = core::subtract(state.x, step.dx);
  const Real distance = core::dot(next, next);
  const Real length = core::dot(step.dx, step.dx);
  const Mask finite = core::is_finite(length) & core::is_finite(distance);
  const Mask moved = active & !step.singular & finite;
  const Mask left = moved & (distance > Real(domain_radius_m * domain_radius_m));
  const Mask converged =
      moved & !left & step.accepted & (length < Real(options.step_tolerance_m * options.step_tolerance_m));

  if constexpr (Method::has_k) {
    if (oracle != nullptr) {
      const Real eta = similarity(options.eta, step.k, true_k(options.k_true, state.x, *oracle));
      const Mask first = moved & (state.iterations < Real(0.5));
      state.eta_first = select(first, eta, state.eta_first);
      state.eta_last = select(moved, eta, state.eta_last);
      state.eta_sum = select(first, eta, select(moved, state.eta_sum + eta, state.eta_sum));
    }
  }
  state.x = core::select<Real>(moved, next, state.x);
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
  const core::Vector3<Real> x = {core::load_column<Real>(out.estimate[0], slot),
                                 core::load_column<Real>(out.estimate[1], slot),
                                 core::load_column<Real>(out.estimate[2], slot)};
  NormalEquations<Real> equations;
  Real squares(0.0);
  for (std::size_t j = 0; j < model.points(); ++j) {
    const RangeObservation<Real> o = model.observe(j, x);
    equations.add(o, method.weight(model.score(j), o.residual, model.points()));
    squares = core::mul_add(o.residual, o.residual, squares);
  }
  const core::LinearSolution<Real> rest = core::solve(equations.matrix, equations.gradient);
  const Real remaining =
      core::select(rest.singular, Real(std::numeric_limits<double>::infinity()), core::sqrt(core::dot(rest.x, rest.x)));
  const Real rms = core::sqrt(squares * Real(1.0 / static_cast<double>(model.points())));
  core::store_column<Real>(out.residual_rms_m, slot, rms);
  core::store_column<Real>(out.remaining_step_m, slot, remaining);
}

/// Writes where the trials in the slots slot, slot + 1, ... stand.
template <class Real, std::size_t MemorySize>
[[gnu::flatten]] void store_state(const IterationState<Real, MemorySize>& state, std::size_t slot,
                                  core::SolutionBatch& out) {
  for (std::size_t i = 0; i < 3; ++i) core::store_column<Real>(out.estimate[i], slot, state.x[i]);
  core::store_column<Real>(std::span<std::uint8_t>(out.status), slot, state.status);
  core::store_column<Real>(out.iterations, slot, state.iterations);
  core::store_column<Real>(out.eta_first, slot, state.eta_first);
  core::store_column<Real>(out.eta_last, slot, state.eta_last);
  core::store_column<Real>(out.eta_mean, slot, state.eta_sum * core::reciprocal(state.iterations));
}

}  // namespace ridgeloc::solvers
