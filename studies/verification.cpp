#include "studies/verification.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <random>
#include <set>
#include <tuple>

#include "results/block.hpp"

namespace ridgeloc::studies {

namespace {

/// Compares one block. Methods may know it with different numbers of trials, if it is the last one of each.
std::vector<BlockDifference> differences_of(const Study& study, const Plan& plan, const results::Ledger& ledger,
                                            const BlockNumber& where, Workspace& workspace) {
  std::set<std::uint64_t> lengths;
  for (std::size_t m = 0; m < plan.header.methods.size(); ++m) {
    if (const auto known = ledger.find(where.cell, m, where.block)) lengths.insert(known->trials);
  }
  std::vector<BlockDifference> differences;
  for (const std::uint64_t trials : lengths) {
    results::BlockSink sink(plan.header, where.cell, where.block, trials);
    const TrialRange range{where.block * plan.header.block_trials, static_cast<std::size_t>(trials)};
    study.experiment->run_block({study.seed, study.audit}, plan.cells[where.cell], study.methods, range, workspace,
                                sink);
    for (const results::Row& row : sink.take_rows()) {
      const auto known = ledger.find(where.cell, row.method, where.block);
      if (known && known->trials == trials && known->digest != row.digests.front())
        differences.push_back({where, row.method});
    }
  }
  return differences;
}

}  // namespace

std::vector<BlockNumber> random_blocks(const results::Ledger& ledger, std::size_t count, std::uint64_t seed) {
  std::uint64_t total = 0;
  for (const results::Row& row : ledger.rows()) total += row.blocks;
  std::set<BlockNumber> chosen;
  if (total == 0) return {};
  std::mt19937_64 engine(seed);
  // The same block can be drawn twice, for another method: some more draws than blocks, then fewer blocks.
  constexpr std::size_t draws_per_block = 20;
  for (std::size_t draw = 0; draw < draws_per_block * count && chosen.size() < count; ++draw) {
    std::uint64_t place = engine() % total;
    for (const results::Row& row : ledger.rows()) {
      if (place < row.blocks) {
        chosen.insert({row.cell, row.first_block + place});
        break;
      }
      place -= row.blocks;
    }
  }
  return {chosen.begin(), chosen.end()};
}

std::vector<BlockDifference> differing_blocks(const Study& study, const Plan& plan, const results::Ledger& ledger,
                                              const std::vector<BlockNumber>& blocks, int threads) {
  std::vector<BlockDifference> all;
  std::mutex mutex;
  tbb::enumerable_thread_specific<std::unique_ptr<Workspace>> workspaces(
      [&] { return study.experiment->make_workspace(plan.isa); });
  // The arena sets how many threads this uses; the control lets it exceed the number of processors.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
      const auto found = differences_of(study, plan, ledger, blocks[i], *workspaces.local());
      const std::scoped_lock lock(mutex);
      all.insert(all.end(), found.begin(), found.end());
    });
  });
  std::ranges::sort(all, {}, [](const BlockDifference& d) { return std::tuple(d.where, d.method); });
  return all;
}

}  // namespace ridgeloc::studies
