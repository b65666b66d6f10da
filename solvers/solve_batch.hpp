#pragma once

#include <bit>
#include <cstdint>

#include "solvers/iteration.hpp"
#include "solvers/range_model.hpp"
#include "solvers/survivors.hpp"

/// How a method runs over all trials of a batch: x <- x - dx until |dx| < step_tolerance_m, the last step applied and
/// counted, for at most max_iterations steps.
namespace ridgeloc::solvers {

/// Steps that a group of lanes takes together before the trials that have converged give their lanes away.
inline constexpr int straight_steps = 3;

namespace detail {

/// The trials that go on after the first steps, in lanes that are refilled as trials finish.
template <class Real, class Model, class Method>
class LaneQueue {
 public:
  using State = IterationState<Real, Method::memory_size>;

  LaneQueue(const Method& method, const core::ProblemBatch& problems, const core::Oracle* oracle)
      : method_(method), problems_(problems), oracle_(oracle), survivors_(survivors_of_thread()) {
    survivors_.reshape(problems, State::values, lanes);
  }

  /// Puts the lanes of a group that are marked in `bits` aside.
  void push(State& state, std::size_t slot, std::uint32_t bits) {
    double spilled[State::values][lanes];
    spill(state, spilled);
    for (; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      double* const row = survivors_.push(slot + lane);
      for (std::size_t v = 0; v < State::values; ++v) row[v] = spilled[v][lane];
    }
  }

  /// Runs all of them to their ends.
  void finish(core::SolutionBatch& out) {
    std::uint32_t going = 0;
    for (;;) {
      for (std::size_t lane = 0; lane < lanes && !survivors_.empty(); ++lane) {
        if ((going >> lane & 1U) == 0) {
          admit(lane);
          going |= 1U << lane;
        }
      }
      if (going == 0) return;
      const std::uint32_t left = run(going);
      for (std::uint32_t done = going & ~left; done != 0; done &= done - 1) {
        retire(static_cast<std::size_t>(std::countr_zero(done)), out);
      }
      going = left;
    }
  }

 private:
  static constexpr std::size_t lanes = core::lanes<Real>;

  static void spill(State& state, double (&values)[State::values][lanes]) {
    std::size_t v = 0;
    state.for_each_value([&](const Real& value) { core::store(values[v++], value); });
  }

  void admit(std::size_t lane) {
    const Survivors::Entry entry = survivors_.pop(problems_, lane);
    trial_[lane] = entry.trial;
    number_[lane] = static_cast<double>(entry.trial);
    for (std::size_t v = 0; v < State::values; ++v) values_[v][lane] = entry.state[v];
    if (oracle_ != nullptr) {
      for (std::size_t axis = 0; axis < 3; ++axis) truth_[axis][lane] = oracle_->truth[axis][entry.trial];
    }
  }

  /// Steps until enough lanes have finished to be worth refilling; returns those that go on.
  std::uint32_t run(std::uint32_t going) {
    State state;
    std::size_t v = 0;
    state.for_each_value([&](Real& value) { value = core::load<Real>(values_[v++]); });
    double marks[lanes];
    for (std::size_t lane = 0; lane < lanes; ++lane) marks[lane] = (going >> lane & 1U) != 0 ? 1.0 : 0.0;
    core::Mask<Real> active = core::load<Real>(marks) > Real(0.5);

    const Model model(survivors_.problems(), 0);
    TrialOracle<Real> known;
    if (oracle_ != nullptr) {
      core::Oracle here = *oracle_;
      for (std::size_t axis = 0; axis < 3; ++axis) here.truth[axis] = truth_[axis];
      known = oracle_of<Real>(here, 0, core::Words<Real>(oracle_->first_trial) + core::to_words(core::load<Real>(number_)));
    }
    const TrialOracle<Real>* const oracle = oracle_ != nullptr ? &known : nullptr;

    const int enough = survivors_.empty() ? 0 : static_cast<int>(lanes - lanes / 4);
    std::uint32_t left;
    do {
      active = advance(method_, model, oracle, state, active);
      left = core::lane_bits(active);
    } while (std::popcount(left) > enough);
    spill(state, values_);
    return left;
  }

  void retire(std::size_t lane, core::SolutionBatch& out) const {
    const std::size_t trial = trial_[lane];
    for (std::size_t axis = 0; axis < 3; ++axis) out.estimate[axis][trial] = values_[axis][lane];
    out.iterations[trial] = values_[3][lane];
    out.status[trial] = static_cast<std::uint8_t>(values_[4][lane]);
    out.eta_first[trial] = values_[5][lane];
    out.eta_last[trial] = values_[6][lane];
    out.eta_mean[trial] = values_[7][lane] * (1.0 / values_[3][lane]);
  }

  const Method& method_;
  const core::ProblemBatch& problems_;
  const core::Oracle* oracle_;
  Survivors& survivors_;
  alignas(64) double values_[State::values][lanes] = {};
  alignas(64) double truth_[3][lanes] = {};
  alignas(64) double number_[lanes] = {};
  std::size_t trial_[lanes] = {};
};

}  // namespace detail

/// Several trials at a time. What a trial comes to does not depend on its lane, its neighbours or the order in which
/// lanes are refilled: every operation is its lane's alone.
template <class Model, class Method, class Real = typename Model::Real>
void solve_batch(const Method& method, const core::ProblemBatch& problems, const core::Oracle* oracle,
                 core::SolutionBatch& out) {
  detail::LaneQueue<Real, Model, Method> queue(method, problems, oracle);
  const Real limit(static_cast<double>(method.options.max_iterations) - 0.5);
  const Real end(static_cast<double>(problems.trials()));
  for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
    const Model model(problems, slot);
    TrialOracle<Real> known;
    if (oracle != nullptr) known = oracle_of<Real>(*oracle, slot, core::trial_words<Real>(oracle->first_trial + slot));
    IterationState<Real, Method::memory_size> state{model.start()};
    core::Mask<Real> active = (core::lane_numbers<Real>(slot) < end) & (state.iterations < limit);
    for (int step = 0; step < straight_steps; ++step) {
      active = advance(method, model, oracle != nullptr ? &known : nullptr, state, active);
    }
    store_state(state, slot, out);
    if (const std::uint32_t bits = core::lane_bits(active); bits != 0) queue.push(state, slot, bits);
  }
  queue.finish(out);
  for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
    evaluate_estimate(method, Model(problems, slot), slot, out);
  }
}

/// One trial at a time: the plain form of the same, for reference.
template <class Model, class Method>
void solve_one_by_one(const Method& method, const core::ProblemBatch& problems, const core::Oracle* oracle,
                      core::SolutionBatch& out) {
  for (std::size_t trial = 0; trial < problems.trials(); ++trial) {
    const Model model(problems, trial);
    TrialOracle<double> known;
    if (oracle != nullptr) known = oracle_of<double>(*oracle, trial, oracle->first_trial + trial);
    IterationState<double, Method::memory_size> state{model.start()};
    bool active = method.options.max_iterations > 0;
    while (active) active = advance(method, model, oracle != nullptr ? &known : nullptr, state, active);
    store_state(state, trial, out);
    evaluate_estimate(method, model, trial, out);
  }
}

}  // namespace ridgeloc::solvers
