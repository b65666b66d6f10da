#include "studies/failure_audit.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <mutex>

namespace ridgeloc::studies {

std::vector<FailureCounts> audit_failures(const Study& study, const Plan& plan, std::uint64_t trials, int threads) {
  const Experiment& experiment = *study.experiment;
  const std::uint64_t block = plan.header.block_trials;
  const std::uint64_t blocks = (trials + block - 1) / block;
  const std::size_t methods = study.methods.size();
  std::vector<FailureCounts> totals(plan.cells.size() * methods);
  std::mutex mutex;
  tbb::enumerable_thread_specific<std::unique_ptr<Workspace>> workspaces(
      [&] { return experiment.make_workspace(plan.isa); });
  // The arena sets how many threads this uses; the control lets it exceed the number of processors.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::uint64_t{0}, plan.cells.size() * blocks, [&](std::uint64_t task) {
      const Cell& cell = plan.cells[task / blocks];
      const std::uint64_t first = task % blocks * block;
      const TrialRange range{first, static_cast<std::size_t>(std::min(block, trials - first))};
      const auto counts = experiment.count_failures(study.seed, cell, study.methods, range, *workspaces.local());
      const std::scoped_lock lock(mutex);
      for (std::size_t m = 0; m < methods; ++m) {
        FailureCounts& total = totals[cell.index * methods + m];
        total.has_reference = counts[m].has_reference;
        total.trials += counts[m].trials;
        total.failed += counts[m].failed;
        total.from_start += counts[m].from_start;
        total.from_truth += counts[m].from_truth;
      }
    });
  });
  return totals;
}

}  // namespace ridgeloc::studies
