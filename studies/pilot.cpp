#include "studies/pilot.hpp"

#include <algorithm>
#include <chrono>

namespace ridgeloc::studies {

Pilot run_pilot(const Study& study, const Plan& plan, double budget_s) {
  using Clock = std::chrono::steady_clock;
  const auto seconds_since = [](Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  const auto workspace = study.experiment->make_workspace(plan.isa);
  const Clock::time_point begin = Clock::now();
  Pilot pilot;
  for (std::uint64_t count = 16; count <= plan.header.block_trials && seconds_since(begin) < budget_s; count *= 4) {
    double seconds = 0.0;
    std::uint64_t trials = 0;
    for (const Cell& cell : plan.cells) {
      const auto cell_begin = Clock::now();
      results::BlockSink sink(plan.header, cell.index, 0, count);
      study.experiment->run_block(study.seed, cell, study.methods, {0, static_cast<std::size_t>(count)}, *workspace,
                                  sink);
      seconds += seconds_since(cell_begin);
      trials += count;
    }
    // The last round is the longest and so the least disturbed by what happens once.
    pilot.seconds_per_trial = seconds / static_cast<double>(trials);
    pilot.trials += trials;
  }
  return pilot;
}

}  // namespace ridgeloc::studies
