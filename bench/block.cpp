#include "bench/block.hpp"

#include <string>
#include <vector>

#include "results/blocks/block.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/plan/assignment.hpp"
#include "studies/registry.hpp"

namespace ridgeloc::bench {

namespace {

studies::Study sweep_study() {
  // Its trials must cover every block that a benchmark may ask for.
  return studies::read_study(studies::find_study(RIDGELOC_SWEEP_STUDY),
                             std::vector<std::string>{"trials=1000000000000"});
}

}  // namespace

BlockRun::BlockRun(core::Isa isa)
    : study_(sweep_study()),
      plan_(studies::make_plan(study_, isa)),
      simulation_(study_.experiment->prepare(study_.seed, plan_.cells[0], study_.methods)),
      workspace_(study_.experiment->make_workspace(isa)) {}

void BlockRun::run(std::uint64_t block) {
  const studies::TrialRange range = studies::everything(plan_).range(block);
  results::BlockSink sink(plan_.header, 0, block, range.count);
  studies::NoMonitor monitor;
  static_cast<void>(simulation_->run_block(range, *workspace_, monitor, sink));
}

}  // namespace ridgeloc::bench
