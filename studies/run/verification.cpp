#include "studies/run/verification.hpp"

#include <algorithm>
#include <mutex>
#include <random>
#include <set>
#include <tuple>
#include <utility>

#include "results/blocks/block.hpp"
#include "studies/run/workbench.hpp"

namespace ridgeloc::studies {

namespace {

/// Compares one block. Methods may know it with different numbers of trials, if it is the last one of each.
std::vector<BlockDifference> differences_of(const Simulation& simulation, const Plan& plan,
                                            const results::Ledger& ledger, const BlockNumber& where,
                                            Workspace& workspace) {
  std::set<std::uint64_t> lengths;
  for (std::size_t m = 0; m < plan.header.methods.size(); ++m) {
    if (const auto known = ledger.find(where.cell, m, where.block)) lengths.insert(known->trials);
  }
  std::vector<BlockDifference> differences;
  for (const std::uint64_t trials : lengths) {
    results::BlockSink sink(plan.header, where.cell, where.block, trials);
    const TrialRange range{where.block * plan.header.block_trials, static_cast<std::size_t>(trials)};
    NoMonitor monitor;
    if (!simulation.run_block(range, workspace, monitor, sink)) continue;
    for (const results::Row& row : sink.take_rows()) {
      const auto known = ledger.find(where.cell, row.method, where.block);
      if (known && known->trials == trials && known->digest != row.digests.front())
        differences.push_back({where, row.method});
    }
  }
  return differences;
}

}  // namespace

std::vector<BlockNumber> all_blocks(const results::Ledger& ledger) {
  std::vector<BlockNumber> blocks;
  for (const results::Row& row : ledger.rows())
    for (std::uint64_t i = 0; i < row.blocks; ++i) blocks.push_back({row.cell, row.first_block + i});
  std::ranges::sort(blocks);
  const auto repeated = std::ranges::unique(blocks);  // by other methods
  blocks.erase(repeated.begin(), repeated.end());
  return blocks;
}

std::vector<BlockNumber> random_choice(std::vector<BlockNumber> blocks, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 engine(seed);
  const std::size_t chosen = std::min(count, blocks.size());
  for (std::size_t i = 0; i < chosen; ++i) std::swap(blocks[i], blocks[i + engine() % (blocks.size() - i)]);
  blocks.resize(chosen);
  std::ranges::sort(blocks);
  return blocks;
}

std::vector<BlockDifference> differing_blocks(const Study& study, const Plan& plan, const results::Ledger& ledger,
                                              const std::vector<BlockNumber>& blocks, WorkQueue& queue) {
  std::vector<BlockDifference> all;
  std::mutex mutex;
  Workbench bench(study, plan, queue.workers());
  queue.run_all(blocks.size(), [&](std::uint64_t i, std::size_t worker) {
    const BlockNumber& where = blocks[i];
    const Simulation& simulation = bench.simulation(worker, where.cell, study.methods);
    const auto found = differences_of(simulation, plan, ledger, where, bench.workspace(worker));
    const std::scoped_lock lock(mutex);
    all.insert(all.end(), found.begin(), found.end());
  });
  std::ranges::sort(all, {}, [](const BlockDifference& d) { return std::tuple(d.where, d.method); });
  return all;
}

}  // namespace ridgeloc::studies
