#pragma once

#include "results/blocks/block.hpp"
#include "studies/plan/assignment.hpp"
#include "studies/plan/plan.hpp"
#include "studies/study/capabilities.hpp"
#include "studies/study/study.hpp"
#include "tests/support/catch.hpp"

namespace ridgeloc::tests {

/// A cell of a study, prepared with all its methods, and a workspace to run it with.
struct PreparedCell {
  PreparedCell(const studies::Study& study, const studies::Cell& cell, core::Isa isa, double audit = 0.0)
      : simulation(study.experiment->prepare({study.seed, audit}, cell, study.methods)),
        workspace(study.experiment->make_workspace(isa)) {}

  void run(studies::TrialRange range, results::BlockSink& sink) const {
    studies::NoMonitor monitor;
    REQUIRE(simulation->run_block(range, *workspace, monitor, sink));
  }
  std::vector<studies::FailureCounts> count_failures(studies::TrialRange range) const {
    return offer<studies::FailureRecount>().count_failures(range, *workspace);
  }
  studies::Replay replay(std::uint64_t trial) const { return offer<studies::TrialReplay>().replay(trial, *workspace); }

  std::unique_ptr<const studies::Simulation> simulation;
  std::unique_ptr<studies::Workspace> workspace;

 private:
  template <class Capability>
  const Capability& offer() const {
    const auto* found = studies::offered<Capability>(*simulation);
    REQUIRE(found != nullptr);
    return *found;
  }
};

/// The rows of the first block of a study's only cell, one per method and one for the scene.
inline std::vector<results::Row> first_block(const studies::Study& study, core::Isa isa = core::Isa::Baseline,
                                             double audit = 0.0) {
  const studies::Plan plan = studies::make_plan(study, isa);
  const studies::TrialRange range = studies::everything(plan).range(0);
  results::BlockMethods methods = results::all_methods(plan.header);
  methods.differences.clear();
  results::BlockSink sink(plan.header, 0, 0, range.count, std::move(methods));
  PreparedCell(study, plan.cells[0], plan.isa, audit).run(range, sink);
  return sink.take_rows();
}

}  // namespace ridgeloc::tests
