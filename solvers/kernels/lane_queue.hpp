#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "solvers/kernels/iteration.hpp"
#include "solvers/kernels/survivors.hpp"

namespace ridgeloc::solvers {

/// The trials that go on after the first steps, in lanes that are refilled as trials finish.
template <class Real, class Model, class Method>
class LaneQueue {
 public:
  using State = IterationState<Real, Model::unknowns, Method::template memory_size<Model::unknowns>>;

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
      if (!oracle_->image_distance.empty()) truth_[3][lane] = oracle_->image_distance[entry.trial];
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

    const Model model(survivors_.problems(), 0, method_.options);
    TrialOracle<Real, Model::unknowns> known;
    if (oracle_ != nullptr) {
      core::Oracle here = *oracle_;
      for (std::size_t axis = 0; axis < 3; ++axis) here.truth[axis] = truth_[axis];
      here.image_distance = truth_[3];
      known = oracle_of(model, here, 0,
                        core::Words<Real>(oracle_->first_trial) + core::to_words(core::load<Real>(number_)));
    }
    const auto* const oracle = oracle_ != nullptr ? &known : nullptr;

    const int enough = survivors_.empty() ? 0 : static_cast<int>(lanes - lanes / 4);
    std::uint32_t left;
    do {
      active = advance(method_, model, oracle, state, active);
      left = core::lane_bits(active);
    } while (std::popcount(left) > enough);
    spill(state, values_);
    store_state(model, state, 0, survivors_.finished());
    return left;
  }

  /// Copies what came of the trial in a lane to its place among the others.
  void retire(std::size_t lane, core::SolutionBatch& out) const {
    const std::size_t trial = trial_[lane];
    const core::SolutionBatch& finished = survivors_.finished();
    for (std::size_t axis = 0; axis < 3; ++axis) out.estimate[axis][trial] = finished.estimate[axis][lane];
    out.status[trial] = finished.status[lane];
    for (const auto column :
         {&core::SolutionBatch::image_distance_mm, &core::SolutionBatch::iterations, &core::SolutionBatch::eta_first,
          &core::SolutionBatch::eta_last, &core::SolutionBatch::eta_mean}) {
      (out.*column)[trial] = (finished.*column)[lane];
    }
  }

  const Method& method_;
  const core::ProblemBatch& problems_;
  const core::Oracle* oracle_;
  Survivors& survivors_;
  alignas(64) double values_[State::values][lanes] = {};
  alignas(64) double truth_[4][lanes] = {};  ///< position, image distance
  alignas(64) double number_[lanes] = {};
  std::size_t trial_[lanes] = {};
};

}  // namespace ridgeloc::solvers
