#pragma once

#include <cstdint>
#include <memory>

#include "core/isa.hpp"
#include "studies/plan/plan.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::bench {

/// What `ridgeloc run` computes in a block of the study that bench/sweep.py times, without the runner and the store:
/// generation, solving, metrics and statistics.
class BlockRun {
 public:
  explicit BlockRun(core::Isa isa);

  /// Computes one block.
  void run(std::uint64_t block);
  std::uint64_t trials() const { return plan_.header.block_trials; }

 private:
  studies::Study study_;
  studies::Plan plan_;
  std::unique_ptr<const studies::Simulation> simulation_;
  std::unique_ptr<studies::Workspace> workspace_;
};

}  // namespace ridgeloc::bench
