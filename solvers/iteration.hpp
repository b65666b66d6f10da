#pragma once

#include <limits>

#include "core/matrix3.hpp"
#include "core/problem.hpp"
#include "core/real.hpp"
#include "core/solution.hpp"
#include "core/status.hpp"
#include "solvers/normal_equations.hpp"
#include "solvers/options.hpp"
#include "solvers/range_model.hpp"
#include "solvers/true_k.hpp"

/// Iterative methods over `Real`. A `Method` has `static constexpr bool has_k`, a `Memory<Real>` that it carries from
/// step to step, and
///   Step<Real> step(model, x, iteration, trial, Memory<Real>&) const;
///   Real weight(score, residual, points) const;   // its weights at the estimate, for the remaining step
namespace ridgeloc::solvers {

/// Positions further out than this (m) have left the domain of the model.
inline constexpr double domain_radius_m = 1e6;

/// What a method proposes at one iterate.
template <class Real>
struct Step {
  core::Vector3<Real> dx;     ///< x <- x - dx
  core::Mask<Real> singular;  ///< a matrix could not be inverted: no step
  core::Mask<Real> accepted;  ///< whether |dx| may meet the stop rule
  core::Vector3<Real> k;      ///< the ridge parameter used, for methods that have one
};

/// Where the trials in the lanes stand. Lanes need not be at the same iteration.
template <class Real>
struct IterationState {
  core::Vector3<Real> x;
  Real iterations{0.0};
  Real status{static_cast<double>(core::Status::MaxIterations)};
  Real eta_first{std::numeric_limits<double>::quiet_NaN()};
  Real eta_last{std::numeric_limits<double>::quiet_NaN()};
  Real eta_sum{0.0};
};

/// Takes one step in every active lane and returns which lanes go on.
template <class Real, class Method>
core::Mask<Real> advance(const Method& method, const RangeModel<Real>& model, const SolverOptions& options,
                         const core::Oracle* oracle, core::Index<Real> trial,
                         typename Method::template Memory<Real>& memory, IterationState<Real>& state,
                         core::Mask<Real> active) {
  using core::select;
  using Mask = core::Mask<Real>;
  const auto code = [](core::Status status) { return Real(static_cast<double>(status)); };

  const Step<Real> step = method.step(model, state.x, state.iterations, trial, memory);
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
      const Real eta = similarity(options.eta, step.k, true_k(options.k_true, state.x, *oracle, trial));
      state.eta_first = select(moved & (state.iterations < Real(0.5)), eta, state.eta_first);
      state.eta_last = select(moved, eta, state.eta_last);
      state.eta_sum = select(moved, state.eta_sum + eta, state.eta_sum);
    }
  }
  state.x = core::select<Real>(moved, next, state.x);
  state.iterations = select(moved, state.iterations + Real(1.0), state.iterations);
  state.status = select(active & step.singular, code(core::Status::Singular), state.status);
  state.status = select(active & !step.singular & !finite, code(core::Status::NonFinite), state.status);
  state.status = select(left, code(core::Status::LeftDomain), state.status);
  state.status = select(converged, code(core::Status::Converged), state.status);
  const Real limit(static_cast<double>(options.max_iterations) - 0.5);
  return moved & !left & !converged & (state.iterations < limit);
}

/// Writes what the trials in the lanes came to.
template <class Real, class Method>
void finish(const Method& method, const RangeModel<Real>& model, core::Index<Real> trial,
            const IterationState<Real>& state, core::SolutionBatch& out) {
  NormalEquations<Real> equations;
  Real squares(0.0);
  for (std::size_t j = 0; j < model.points(); ++j) {
    const RangeObservation<Real> o = model.observe(j, state.x);
    equations.add(o, method.weight(model.score(j), o.residual, model.points()));
    squares = squares + o.residual * o.residual;
  }
  const core::LinearSolution<Real> rest = core::solve(equations.matrix, equations.gradient);
  const Real remaining =
      core::select(rest.singular, Real(std::numeric_limits<double>::infinity()), core::sqrt(core::dot(rest.x, rest.x)));

  for (std::size_t i = 0; i < 3; ++i) core::store(out.estimate[i], trial, state.x[i]);
  core::store_status(out.status, trial, state.status);
  core::store(out.iterations, trial, state.iterations);
  core::store(out.residual_rms_m, trial, core::sqrt(squares / Real(static_cast<double>(model.points()))));
  core::store(out.remaining_step_m, trial, remaining);
  if constexpr (Method::has_k) {
    core::store(out.eta_first, trial, state.eta_first);
    core::store(out.eta_last, trial, state.eta_last);
    core::store(out.eta_mean, trial, state.eta_sum / state.iterations);
  }
}

/// Runs a method on the trials in the lanes of one `Real`: x <- x - dx until |dx| < step_tolerance_m, the last step
/// applied and counted, for at most max_iterations steps.
template <class Real, class Method>
void iterate(const Method& method, const core::ProblemBatch& problems, const SolverOptions& options,
             const core::Oracle* oracle, core::Index<Real> trial, core::SolutionBatch& out) {
  const RangeModel<Real> model(problems, trial);
  typename Method::template Memory<Real> memory{};
  IterationState<Real> state{model.start()};
  core::Mask<Real> active = state.iterations < Real(static_cast<double>(options.max_iterations));
  while (core::any(active)) active = advance(method, model, options, oracle, trial, memory, state, active);
  finish(method, model, trial, state, out);
}

/// Runs a method on every problem of a batch.
template <class Method>
void solve_batch(const Method& method, const core::ProblemBatch& problems, const SolverOptions& options,
                 const core::Oracle* oracle, core::SolutionBatch& out) {
  out.reshape(problems.trials());
  for (std::size_t trial = 0; trial < problems.trials(); ++trial) {
    iterate<double>(method, problems, options, oracle, trial, out);
  }
}

}  // namespace ridgeloc::solvers
