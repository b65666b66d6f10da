#include "studies/run/runner.hpp"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "results/blocks/block.hpp"
#include "results/store/result_writer.hpp"
#include "studies/run/stop_rounds.hpp"

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

std::uint64_t tasks_of(const Stretch& stretch) {
  return (stretch.end - stretch.first + blocks_per_task - 1) / blocks_per_task;
}

/// One run: what is to be done, and where it goes.
class Run {
 public:
  Run(const Study& study, const Plan& plan, const Assignment& assignment, results::ResultWriter& writer,
      RunProgress& progress, const std::atomic<bool>& stop)
      : study_(study),
        plan_(plan),
        assignment_(assignment),
        writer_(writer),
        progress_(progress),
        stop_(stop),
        workspaces_([&study, &plan] { return study.experiment->make_workspace(plan.isa); }) {}

  /// Computes what is missing of some stretches, in their order as far as threads have one.
  void compute(const std::vector<Stretch>& stretches);

  /// All blocks of the assignment.
  std::vector<Stretch> everything() const;

  /// The blocks that are there of every method; they may lack the values of their trials.
  std::vector<Stretch> present() const;

  /// Blocks of the assigned cells that are there, of all shares.
  std::uint64_t blocks_kept() const;

  std::uint64_t blocks_found() const { return found_.load(); }
  std::uint64_t blocks_run() const { return computed_.load(); }

 private:
  void compute_task(const Stretch& stretch, std::uint64_t task);

  const Study& study_;
  const Plan& plan_;
  const Assignment& assignment_;
  results::ResultWriter& writer_;
  RunProgress& progress_;
  const std::atomic<bool>& stop_;
  tbb::enumerable_thread_specific<std::unique_ptr<Workspace>> workspaces_;
  std::atomic<std::uint64_t> found_{0};
  std::atomic<std::uint64_t> computed_{0};
};

void Run::compute_task(const Stretch& stretch, std::uint64_t task) {
  const Cell& cell = plan_.cells[assignment_.cells[stretch.place]];
  const std::uint64_t first = stretch.first + task * blocks_per_task;
  const std::uint64_t end = std::min(first + blocks_per_task, stretch.end);
  std::vector<results::BlockSink> sinks;
  for (std::uint64_t block = first; block < end && !stop_.load(std::memory_order_relaxed); ++block) {
    if (!assignment_.contains(stretch.place, block)) continue;
    const TrialRange range = assignment_.range(block);
    const auto missing = writer_.missing_methods(cell.index, block, range.count, assignment_.methods);
    if (missing.empty()) {
      found_.fetch_add(1, std::memory_order_relaxed);
    } else {
      BlockWork work = block_work(study_, plan_.header, missing);
      results::BlockSink& sink =
          sinks.emplace_back(plan_.header, cell.index, block, range.count, std::move(work.wanted));
      study_.experiment->run_block({study_.seed, study_.audit}, cell, work.methods, range, *workspaces_.local(), sink);
      computed_.fetch_add(1, std::memory_order_relaxed);
      progress_.trials_done.fetch_add(range.count, std::memory_order_relaxed);
    }
    progress_.blocks_done.fetch_add(1, std::memory_order_relaxed);
  }
  if (!sinks.empty()) writer_.add(std::move(sinks));
}

void Run::compute(const std::vector<Stretch>& stretches) {
  std::vector<std::uint64_t> tasks_before = {0};
  for (const Stretch& stretch : stretches) tasks_before.push_back(tasks_before.back() + tasks_of(stretch));
  tbb::task_group_context context;
  tbb::parallel_for(
      tbb::blocked_range<std::uint64_t>(0, tasks_before.back(), 1),
      [&](const tbb::blocked_range<std::uint64_t>& range) {
        // Without this a stop would still visit every task there is, and there may be billions.
        if (stop_.load(std::memory_order_relaxed)) context.cancel_group_execution();
        for (std::uint64_t task = range.begin(); task != range.end(); ++task) {
          const auto after = std::ranges::upper_bound(tasks_before, task);
          const auto i = static_cast<std::size_t>(after - tasks_before.begin()) - 1;
          compute_task(stretches[i], task - tasks_before[i]);
        }
      },
      tbb::simple_partitioner{}, context);
}

std::vector<Stretch> Run::everything() const {
  std::vector<Stretch> all;
  for (std::size_t place = 0; place < assignment_.cells.size(); ++place)
    all.push_back({place, 0, assignment_.blocks_per_cell()});
  return all;
}

std::vector<Stretch> Run::present() const {
  std::vector<Stretch> all;
  for (std::size_t place = 0; place < assignment_.cells.size(); ++place)
    all.push_back({place, 0, writer_.extent(assignment_.cells[place], assignment_.methods).unbroken});
  return all;
}

std::uint64_t Run::blocks_kept() const {
  std::uint64_t sum = 0;
  for (const std::size_t cell : assignment_.cells)
    sum += writer_.blocks_there(cell, assignment_.trials, assignment_.methods);
  return sum;
}

}  // namespace

RunOutcome run_study(const Study& study, const Plan& plan, const Assignment& assignment,
                     const std::filesystem::path& output, int threads, results::Provenance provenance,
                     RunProgress& progress, const std::atomic<bool>& stop) {
  using Totals = results::ResultWriter::Totals;
  results::ResultWriter writer(output, plan.header, study.stop ? Totals::Kept : Totals::Dropped);
  Assignment own = assignment;
  if (study.stop) own.trials = looks(*study.stop, own.block_trials).back() * own.block_trials;
  Run run(study, plan, own, writer, progress, stop);
  const auto begin = std::chrono::steady_clock::now();
  // The arena sets how many threads this run uses; the control lets it exceed the number of processors.
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  std::uint64_t blocks = 0;
  const auto compute = [&](const std::vector<Stretch>& stretches, std::uint64_t more) {
    blocks += more;
    progress.blocks_total = blocks;
    run.compute(stretches);
  };
  arena.execute([&] {
    if (!study.stop) return compute(run.everything(), own.blocks());
    StopRounds rounds(study, plan, own, writer);
    for (auto round = run.present(); !round.empty() && !stop.load(); round = rounds.next()) {
      std::uint64_t more = 0;
      for (const Stretch& stretch : round) more += stretch.end - stretch.first;
      compute(round, more);
    }
  });

  RunOutcome outcome{false, false, run.blocks_found(), run.blocks_run(), 0, writer.warnings()};
  if (outcome.blocks_found + outcome.blocks_run < blocks || (study.stop && stop.load())) {
    writer.flush();
    // A file may have more than this share, or than the looks so far have asked for.
    outcome.blocks_kept = std::min(run.blocks_kept(), blocks);
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
