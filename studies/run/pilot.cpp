#include "studies/run/pilot.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "studies/study/audit_sample.hpp"

namespace ridgeloc::studies {

namespace {

std::uint64_t predicted(const Study& study, const Plan& plan, std::uint64_t trials, results::BlockSink& sink) {
  std::vector<results::Statistics> statistics(plan.header.methods.size());
  for (results::Row& row : sink.take_rows()) statistics[row.method] = std::move(row.statistics);
  const Precision precision = precision_of(*study.stop, plan.header, statistics);
  return predicted_trials(*study.stop, precision, trials, plan.header.block_trials);
}

}  // namespace

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
    pilot.predicted_trials.clear();
    for (const Cell& cell : plan.cells) {
      const auto cell_begin = Clock::now();
      // Of the second block: the first trials of all are audited, which would cost more than the rest.
      results::BlockSink sink(plan.header, cell.index, 1, count);
      study.experiment->run_block({study.seed, study.audit}, cell, study.methods,
                                  {plan.header.block_trials, static_cast<std::size_t>(count)}, *workspace, sink);
      seconds += seconds_since(cell_begin);
      trials += count;
      if (study.stop) pilot.predicted_trials.push_back(predicted(study, plan, count, sink));
    }
    // The last round is the longest and so the least disturbed by what happens once.
    pilot.seconds_per_trial = seconds / static_cast<double>(trials);
    pilot.trials += trials;
  }
  if (study.audit > 0.0) {
    const std::uint64_t first = std::min(study.trials, always_audited);
    const auto first_begin = Clock::now();
    results::BlockSink sink(plan.header, 0, 0, first);
    study.experiment->run_block({study.seed, study.audit}, plan.cells[0], study.methods,
                                {0, static_cast<std::size_t>(first)}, *workspace, sink);
    pilot.seconds_per_cell =
        std::max(seconds_since(first_begin) - pilot.seconds_per_trial * static_cast<double>(first), 0.0);
  }
  return pilot;
}

}  // namespace ridgeloc::studies
