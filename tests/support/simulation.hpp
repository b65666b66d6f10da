#pragma once

#include "results/blocks/block.hpp"
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

}  // namespace ridgeloc::tests
