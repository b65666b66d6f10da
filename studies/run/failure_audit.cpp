#include "studies/run/failure_audit.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>

#include "studies/run/verification.hpp"

namespace ridgeloc::studies {

namespace {

void add(FailureCounts& total, const FailureCounts& counts) {
  total.has_reference = counts.has_reference;
  total.trials += counts.trials;
  total.failed += counts.failed;
  total.from_start += counts.from_start;
  total.from_truth += counts.from_truth;
}

/// The methods that the ledger has of a block, by how many of its trials. It is the same number for all but where the
/// last block of a cell has grown for some.
std::map<std::uint64_t, std::vector<std::size_t>> methods_by_trials(const Study& study, const results::Ledger& ledger,
                                                                    const BlockNumber& where) {
  std::map<std::uint64_t, std::vector<std::size_t>> groups;
  for (std::size_t m = 0; m < study.methods.size(); ++m)
    if (const auto known = ledger.find(where.cell, m, where.block)) groups[known->trials].push_back(m);
  return groups;
}

}  // namespace

std::vector<FailureCounts> audit_failures(const Study& study, const Plan& plan, const results::Ledger& ledger,
                                          std::uint64_t trials, int threads) {
  const Experiment& experiment = *study.experiment;
  const std::uint64_t block_trials = plan.header.block_trials;
  const std::size_t methods = study.methods.size();
  std::vector<BlockNumber> blocks = all_blocks(ledger);
  std::erase_if(blocks, [&](const BlockNumber& where) { return where.block * block_trials >= trials; });
  std::vector<FailureCounts> totals(plan.cells.size() * methods);
  std::mutex mutex;
  tbb::enumerable_thread_specific<std::unique_ptr<Workspace>> workspaces(
      [&] { return experiment.make_workspace(plan.isa); });
  // The arena sets how many threads this uses; the control lets it exceed the number of processors.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
      const BlockNumber& where = blocks[i];
      const std::uint64_t first = where.block * block_trials;
      for (const auto& [known, numbers] : methods_by_trials(study, ledger, where)) {
        std::vector<Method> group;
        for (const std::size_t m : numbers) group.push_back(study.methods[m]);
        const TrialRange range{first, static_cast<std::size_t>(std::min(known, trials - first))};
        const auto counts =
            experiment.count_failures(study.seed, plan.cells[where.cell], group, range, *workspaces.local());
        const std::scoped_lock lock(mutex);
        for (std::size_t m = 0; m < numbers.size(); ++m) add(totals[where.cell * methods + numbers[m]], counts[m]);
      }
    });
  });
  return totals;
}

}  // namespace ridgeloc::studies
