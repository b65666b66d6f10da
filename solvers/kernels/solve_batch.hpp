#pragma once

#include <cstddef>
#include <cstdint>

#include "solvers/kernels/lane_queue.hpp"

/// How a method runs over all trials of a batch: x <- x - dx until |dx| < step_tolerance_m, the last step applied and
/// counted, for at most max_iterations steps.
namespace ridgeloc::solvers {

/// Steps that a group of lanes takes together before the trials that have converged give their lanes away.
inline constexpr int straight_steps = 3;

/// Several trials at a time. What a trial comes to does not depend on its lane, its neighbours or the order in which
/// lanes are refilled: every operation is its lane's alone.
template <class Model, class Method, class Real = typename Model::Real>
void solve_batch(const Method& method, const core::ProblemBatch& problems, const core::Oracle* oracle,
                 core::SolutionBatch& out) {
  LaneQueue<Real, Model, Method> queue(method, problems, oracle);
  const Real limit(static_cast<double>(method.options.max_iterations) - 0.5);
  const Real end(static_cast<double>(problems.trials()));
  for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
    const Model model(problems, slot, method.options);
    TrialOracle<Real, Model::unknowns> known;
    if (oracle != nullptr) known = oracle_of(model, *oracle, slot, core::trial_words<Real>(oracle->first_trial + slot));
    typename LaneQueue<Real, Model, Method>::State state{first_iterate(model, method.options)};
    core::Mask<Real> active = (core::lane_numbers<Real>(slot) < end) & (state.iterations < limit);
    for (int step = 0; step < straight_steps; ++step) {
      active = advance(method, model, oracle != nullptr ? &known : nullptr, state, active);
    }
    store_state(model, state, slot, out);
    if (const std::uint32_t bits = core::lane_bits(active); bits != 0) queue.push(state, slot, bits);
  }
  queue.finish(out);
  for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
    evaluate_estimate(method, Model(problems, slot, method.options), slot, out);
  }
}

/// One trial at a time: the plain form of the same, for reference.
template <class Model, class Method>
void solve_one_by_one(const Method& method, const core::ProblemBatch& problems, const core::Oracle* oracle,
                      core::SolutionBatch& out) {
  for (std::size_t trial = 0; trial < problems.trials(); ++trial) {
    const Model model(problems, trial, method.options);
    TrialOracle<double, Model::unknowns> known;
    if (oracle != nullptr) known = oracle_of(model, *oracle, trial, oracle->first_trial + trial);
    typename LaneQueue<double, Model, Method>::State state{first_iterate(model, method.options)};
    bool active = method.options.max_iterations > 0;
    while (active) active = advance(method, model, oracle != nullptr ? &known : nullptr, state, active);
    store_state(model, state, trial, out);
    evaluate_estimate(method, model, trial, out);
  }
}

}  // namespace ridgeloc::solvers
