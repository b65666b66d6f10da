#include "studies/runner.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <chrono>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "results/block.hpp"
#include "results/result_writer.hpp"

namespace ridgeloc::studies {

namespace {

/// Blocks that one task computes before it hands them to the store: long enough for the hand-over not to be felt,
/// short enough to share the work evenly and to stop soon.
constexpr std::uint64_t blocks_per_task = 4;

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// What to compute of a block: the solvers, and what the sink is to make of their columns.
struct BlockWork {
  std::vector<Method> methods;
  results::BlockMethods wanted;
};

/// The work for the methods of the header that are missing. A difference needs both its methods, wanted or not.
BlockWork block_work(const Study& study, const results::Header& header, const std::vector<std::size_t>& missing) {
  constexpr std::size_t unwanted = results::BlockMethods::unwanted;
  BlockWork work;
  std::map<std::size_t, std::size_t> places;  // of solvers: number in the header -> place in the block
  const auto place_of = [&](std::size_t number) {
    const auto [place, is_new] = places.emplace(number, work.methods.size());
    if (is_new) {
      work.methods.push_back(study.methods[number]);
      work.wanted.numbers.push_back(unwanted);
    }
    return place->second;
  };
  const std::size_t extras = study.experiment->extra_labels().size();
  std::vector<std::size_t> extra(extras, unwanted);
  for (const std::size_t number : missing) {
    if (const auto& pair = header.methods[number].difference) {
      const std::size_t minuend = place_of((*pair)[0]);
      work.wanted.differences.push_back({number, minuend, place_of((*pair)[1])});
    } else if (number < study.methods.size()) {
      work.wanted.numbers[place_of(number)] = number;
    } else {
      extra[number - study.methods.size()] = number;
    }
  }
  work.wanted.numbers.insert(work.wanted.numbers.end(), extra.begin(), extra.end());
  return work;
}

}  // namespace

RunOutcome run_study(const Study& study, const Plan& plan, const Assignment& assignment,
                     const std::filesystem::path& output, int threads, results::Provenance provenance,
                     RunProgress& progress, const std::atomic<bool>& stop) {
  results::ResultWriter writer(output, plan.header);
  const Experiment& experiment = *study.experiment;
  const std::uint64_t blocks_per_cell = assignment.blocks_per_cell();
  const std::uint64_t tasks_per_cell = (blocks_per_cell + blocks_per_task - 1) / blocks_per_task;
  const std::uint64_t tasks = tasks_per_cell * assignment.cells.size();
  std::atomic<std::uint64_t> found{0};
  std::atomic<std::uint64_t> computed{0};

  const auto begin = std::chrono::steady_clock::now();
  tbb::enumerable_thread_specific<std::unique_ptr<Workspace>> workspaces(
      [&] { return experiment.make_workspace(plan.isa); });
  const auto run_task = [&](std::uint64_t task) {
    const std::size_t place = task / tasks_per_cell;
    const Cell& cell = plan.cells[assignment.cells[place]];
    const std::uint64_t first = task % tasks_per_cell * blocks_per_task;
    const std::uint64_t end = std::min(first + blocks_per_task, blocks_per_cell);
    std::vector<results::BlockSink> sinks;
    for (std::uint64_t block = first; block < end && !stop.load(std::memory_order_relaxed); ++block) {
      if (!assignment.contains(place, block)) continue;
      const TrialRange range = assignment.range(block);
      const auto missing = writer.missing_methods(cell.index, block, range.count, assignment.methods);
      if (missing.empty()) {
        found.fetch_add(1, std::memory_order_relaxed);
      } else {
        BlockWork work = block_work(study, plan.header, missing);
        results::BlockSink& sink =
            sinks.emplace_back(plan.header, cell.index, block, range.count, std::move(work.wanted));
        experiment.run_block({study.seed, study.audit}, cell, work.methods, range, *workspaces.local(), sink);
        computed.fetch_add(1, std::memory_order_relaxed);
        progress.trials_done.fetch_add(range.count, std::memory_order_relaxed);
      }
      progress.blocks_done.fetch_add(1, std::memory_order_relaxed);
    }
    if (!sinks.empty()) writer.add(std::move(sinks));
  };

  // The arena sets how many threads this run uses; the control lets it exceed the number of processors.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] {
    tbb::task_group_context context;
    tbb::parallel_for(
        tbb::blocked_range<std::uint64_t>(0, tasks, 1),
        [&](const tbb::blocked_range<std::uint64_t>& range) {
          // Without this a stop would still visit every task there is, and there may be billions.
          if (stop.load(std::memory_order_relaxed)) context.cancel_group_execution();
          for (std::uint64_t task = range.begin(); task != range.end(); ++task) run_task(task);
        },
        tbb::simple_partitioner{}, context);
  });

  RunOutcome outcome{false, false, found.load(), computed.load(), writer.warnings()};
  if (outcome.blocks_found + outcome.blocks_run < assignment.blocks()) {
    writer.flush();
    return outcome;
  }
  outcome.sealed = true;
  outcome.unchanged = writer.is_current();
  if (outcome.unchanged) return outcome;
  provenance.threads = static_cast<unsigned>(threads);
  provenance.wall_time_s.emplace_back("compute", seconds_since(begin));
  results::complete(provenance);
  writer.seal(provenance);
  return outcome;
}

}  // namespace ridgeloc::studies
