#include "studies/run/failure_audit.hpp"

#include <algorithm>
#include <map>
#include <mutex>

#include "studies/run/verification.hpp"
#include "studies/run/workbench.hpp"

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
                                          std::uint64_t trials, WorkQueue& queue) {
  const std::uint64_t block_trials = plan.header.block_trials;
  const std::size_t methods = study.methods.size();
  std::vector<BlockNumber> blocks = all_blocks(ledger);
  std::erase_if(blocks, [&](const BlockNumber& where) { return where.block * block_trials >= trials; });
  std::vector<FailureCounts> totals(plan.cells.size() * methods);
  std::mutex mutex;
  Workbench bench(study, plan, queue.workers());
  queue.run_all(blocks.size(), [&](std::uint64_t i, std::size_t worker) {
    const BlockNumber& where = blocks[i];
    const std::uint64_t first = where.block * block_trials;
    for (const auto& [known, numbers] : methods_by_trials(study, ledger, where)) {
      std::vector<Method> group;
      for (const std::size_t m : numbers) group.push_back(study.methods[m]);
      const Simulation& simulation = bench.simulation(worker, where.cell, group);
      const auto& recount = required<FailureRecount>(*study.experiment, simulation);
      const TrialRange range{first, static_cast<std::size_t>(std::min(known, trials - first))};
      const auto counts = recount.count_failures(range, bench.workspace(worker));
      const std::scoped_lock lock(mutex);
      for (std::size_t m = 0; m < numbers.size(); ++m) add(totals[where.cell * methods + numbers[m]], counts[m]);
    }
  });
  return totals;
}

}  // namespace ridgeloc::studies
