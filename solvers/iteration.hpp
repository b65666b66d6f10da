#pragma once

#include <limits>

#include "core/matrix3.hpp"
#include "core/problem.hpp"
#include "core/real.hpp"
#include "core/solution.hpp"
#include "core/status.hpp"
#include "solvers/options.hpp"
#include "solvers/range_model.hpp"
#include "solvers/true_k.hpp"

namespace ridgeloc::solvers {

/// Positions further out than this (m) have left the domain of the model.
inline constexpr double domain_radius_m = 1e6;

/// What a method proposes at one iterate.
template <class Real>
struct Step {
  core::Vector3<Real> dx;    ///< x <- x - dx
  core::Mask<Real> singular; ///< a matrix could not be inverted: no step
  core::Mask<Real> accepted; ///< whether |dx| may meet the stop rule
  core::Vector3<Real> k;     ///< the ridge parameter used, for methods that have one
};

/// Runs an iterative method on the lanes of one `Real`: x <- x - dx until |dx| < step_tolerance_m (the last step is
/// applied and counted), for at most max_iterations steps.
///
/// A `Method` has `static constexpr bool has_k`, a `Memory<Real>` that it carries from step to step, and
///   Step<Real> step(model, x, iteration, trial, Memory<Real>&) const;
///   Real weight(score, residual, points) const;   // its weights, for the gradient J'We at the end
template <class Real, class Method>
void iterate(const Method& method, const core::ProblemBatch& problems, const SolverOptions& options,
             const core::Oracle* oracle, core::Index<Real> trial, core::SolutionBatch& out) {
  using core::select;
  using Mask = core::Mask<Real>;
  const auto code = [](core::Status status) { return Real(static_cast<double>(status)); };
  const Real step_limit(options.step_tolerance_m * options.step_tolerance_m);
  const Real domain_limit(domain_radius_m * domain_radius_m);

  const RangeModel<Real> model(problems, trial);
  core::Vector3<Real> x = model.start();
  Real iterations(0.0);
  Real status = code(core::Status::MaxIterations);
  Real eta_first(std::numeric_limits<double>::quiet_NaN());
  Real eta_last = eta_first;
  Real eta_sum(0.0);
  typename Method::template Memory<Real> memory{};
  Mask active = iterations == iterations;

  for (int iteration = 0; iteration < options.max_iterations && core::any(active); ++iteration) {
    const Step<Real> step = method.step(model, x, iteration, trial, memory);
    const core::Vector3<Real> next = core::subtract(x, step.dx);
    const Real distance = core::dot(next, next);
    const Real length = core::dot(step.dx, step.dx);

    const Mask singular = active & step.singular;
    const Mask finite = core::is_finite(length) & core::is_finite(distance);
    const Mask moved = active & !step.singular & finite;
    const Mask left = moved & (distance > domain_limit);
    const Mask converged = moved & !left & step.accepted & (length < step_limit);

    if constexpr (Method::has_k) {
      if (oracle != nullptr) {
        const Real eta = similarity(options.eta, step.k, true_k(options.k_true, x, *oracle, trial));
        eta_first = iteration == 0 ? select(moved, eta, eta_first) : eta_first;
        eta_last = select(moved, eta, eta_last);
        eta_sum = select(moved, eta_sum + eta, eta_sum);
      }
    }
    x = core::select<Real>(moved, next, x);
    iterations = select(moved, iterations + Real(1.0), iterations);
    status = select(singular, code(core::Status::Singular), status);
    status = select(active & !step.singular & !finite, code(core::Status::NonFinite), status);
    status = select(left, code(core::Status::LeftDomain), status);
    status = select(converged, code(core::Status::Converged), status);
    active = moved & !left & !converged;
  }

  core::Vector3<Real> gradient{Real(0.0), Real(0.0), Real(0.0)};
  Real weights(0.0);
  Real squares(0.0);
  for (std::size_t j = 0; j < model.points(); ++j) {
    const RangeObservation<Real> o = model.observe(j, x);
    const Real weight = method.weight(model.score(j), o.residual, model.points());
    for (std::size_t i = 0; i < 3; ++i) gradient[i] = gradient[i] + weight * o.residual * o.direction[i];
    weights = weights + weight;
    squares = squares + o.residual * o.residual;
  }

  for (std::size_t i = 0; i < 3; ++i) core::store(out.estimate[i], trial, x[i]);
  core::store_status(out.status, trial, status);
  core::store(out.iterations, trial, iterations);
  core::store(out.residual_rms_m, trial, core::sqrt(squares / Real(static_cast<double>(model.points()))));
  core::store(out.gradient_m, trial, core::sqrt(core::dot(gradient, gradient)) / weights);
  if (Method::has_k && oracle != nullptr) {
    core::store(out.eta_first, trial, eta_first);
    core::store(out.eta_last, trial, eta_last);
    core::store(out.eta_mean, trial, eta_sum / iterations);
  }
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
