#include "studies/run/runner.hpp"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <utility>
#include <vector>

#include "core/elapsed.hpp"
#include "results/blocks/block.hpp"
#include "results/store/run_record.hpp"
#include "studies/run/block_rounds.hpp"
#include "studies/run/stop_rounds.hpp"
#include "studies/run/workbench.hpp"
#include "studies/study/capabilities.hpp"

namespace ridgeloc::studies {

namespace {

/// Most blocks that one piece of work has: enough for the queue not to be felt.
constexpr std::uint64_t most_blocks_per_piece = 4;

/// Pieces that each worker has at least, where there are blocks enough, so that all end at about the same time.
constexpr std::uint64_t pieces_per_worker = 8;

/// Blocks go to the store after this time at the latest: what a killed program loses of slow ones.
constexpr double hand_over_s = 0.1;

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
  const std::size_t extras = study.experiment->labels().size();
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

/// What the store has, as stop rules ask for it.
class Stored : public FinishedBlocks {
 public:
  explicit Stored(const results::ResultWriter& writer) : writer_(writer) {}

  Extent extent(std::size_t cell, std::uint64_t trials, const std::vector<std::size_t>& methods) const override {
    const auto [unbroken, end] = writer_.extent(cell, trials, methods);
    return {unbroken, end};
  }
  results::Statistics statistics(std::size_t cell, std::size_t method) const override {
    return writer_.statistics(cell, method);
  }

 private:
  const results::ResultWriter& writer_;
};

/// One run: what is to be done, and where it goes.
class Run {
 public:
  Run(const Study& study, const Plan& plan, const Assignment& assignment, results::ResultWriter& writer,
      WorkQueue& queue, RunProgress& progress, const std::atomic<bool>& stop)
      : study_(study),
        plan_(plan),
        assignment_(assignment),
        writer_(writer),
        queue_(queue),
        progress_(progress),
        stop_(stop),
        bench_(study, plan, queue.workers()) {}

  /// Computes what is missing of some stretches.
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
  void compute_piece(const Stretch& piece, std::size_t worker);
  bool compute_block(std::size_t cell, std::uint64_t block, std::size_t worker, std::vector<results::BlockSink>& done);

  const Study& study_;
  const Plan& plan_;
  const Assignment& assignment_;
  results::ResultWriter& writer_;
  WorkQueue& queue_;
  RunProgress& progress_;
  const std::atomic<bool>& stop_;
  Workbench bench_;
  std::atomic<std::uint64_t> found_{0};
  std::atomic<std::uint64_t> computed_{0};
};

/// Computes what a block lacks. Returns whether it came to an end.
bool Run::compute_block(std::size_t cell, std::uint64_t block, std::size_t worker,
                        std::vector<results::BlockSink>& done) {
  const TrialRange range = assignment_.range(block);
  const auto missing = writer_.missing_methods(cell, block, range.count, assignment_.methods);
  if (missing.empty()) {
    found_.fetch_add(1, std::memory_order_relaxed);
    progress_.trials_found.fetch_add(range.count, std::memory_order_relaxed);
  } else {
    BlockWork work = block_work(study_, plan_.header, missing);
    const Simulation& simulation = bench_.simulation(worker, cell, work.methods);
    results::BlockSink sink(plan_.header, cell, block, range.count, std::move(work.wanted));
    Monitor monitor(stop_, progress_.trials_done);
    if (!simulation.run_block(range, bench_.workspace(worker), monitor, sink)) return false;
    monitor.advance(range.count - monitor.advanced());
    done.push_back(std::move(sink));
    computed_.fetch_add(1, std::memory_order_relaxed);
  }
  progress_.blocks_done.fetch_add(1, std::memory_order_relaxed);
  return true;
}

void Run::compute_piece(const Stretch& piece, std::size_t worker) {
  const std::size_t cell = assignment_.cells[piece.place];
  std::vector<results::BlockSink> done;
  auto handed_over = std::chrono::steady_clock::now();
  for (std::uint64_t block = piece.first; block < piece.end && !stop_.load(std::memory_order_relaxed); ++block) {
    if (!assignment_.contains(piece.place, block)) continue;
    if (!compute_block(cell, block, worker, done)) break;
    if (!done.empty() && core::seconds_since(handed_over) > hand_over_s) {
      writer_.add(std::exchange(done, {}));
      handed_over = std::chrono::steady_clock::now();
    }
  }
  if (!done.empty()) writer_.add(std::move(done));
}

void Run::compute(const std::vector<Stretch>& stretches) {
  std::uint64_t blocks = 0;
  for (const Stretch& stretch : stretches) blocks += stretch.end - stretch.first;
  const std::uint64_t size =
      std::clamp<std::uint64_t>(blocks / (queue_.workers() * pieces_per_worker), 1, most_blocks_per_piece);
  const BlockRounds rounds(stretches, size);
  queue_.run(rounds.pieces(), stop_,
             [&](std::uint64_t piece, std::size_t worker) { compute_piece(rounds.piece(piece), worker); });
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
    all.push_back(
        {place, 0, writer_.extent(assignment_.cells[place], assignment_.trials, assignment_.methods).unbroken});
  return all;
}

std::uint64_t Run::blocks_kept() const {
  std::uint64_t sum = 0;
  for (const std::size_t cell : assignment_.cells)
    sum += writer_.blocks_there(cell, assignment_.trials, assignment_.methods);
  return sum;
}

/// What a run says of itself to others.
results::RunRecord record_of(const RunProgress& progress, std::size_t workers, double seconds) {
  results::RunRecord record;
  record.state = progress.is_writing ? results::RunRecord::State::Writing : results::RunRecord::State::Computing;
  record.seconds = seconds;
  record.workers = workers;
  record.blocks_total = progress.blocks_total;
  record.blocks_done = progress.blocks_done;
  record.trials_total = progress.trials_total;
  record.trials_done = progress.trials_done;
  record.trials_found = progress.trials_found;
  return record;
}

/// Trials of the blocks of some stretches.
std::uint64_t trials_of(const Assignment& assignment, const std::vector<Stretch>& stretches) {
  std::uint64_t trials = 0;
  for (const Stretch& stretch : stretches) {
    const std::uint64_t end = std::min(stretch.end * assignment.block_trials, assignment.trials);
    trials += end - std::min(stretch.first * assignment.block_trials, end);
  }
  return trials;
}

}  // namespace

results::ResultWriter writer_of(const Study& study, const Plan& plan, results::ResultClaim output) {
  using Totals = results::ResultWriter::Totals;
  return {std::move(output), plan.header, study.stop ? Totals::Kept : Totals::Dropped};
}

RunOutcome run_study(const Study& study, const Plan& plan, const Assignment& assignment, results::ResultClaim output,
                     WorkQueue& queue, results::Provenance provenance, RunProgress& progress,
                     const std::atomic<bool>& stop) {
  results::ResultWriter writer = writer_of(study, plan, std::move(output));
  return run_study(study, plan, assignment, writer, queue, std::move(provenance), progress, stop);
}

RunOutcome run_study(const Study& study, const Plan& plan, const Assignment& assignment, results::ResultWriter& writer,
                     WorkQueue& queue, results::Provenance provenance, RunProgress& progress,
                     const std::atomic<bool>& stop) {
  Assignment own = assignment;
  if (study.stop) own.trials = study.stop->max_trials;
  Run run(study, plan, own, writer, queue, progress, stop);
  const auto begin = std::chrono::steady_clock::now();
  bool is_recorded = false;
  std::uint64_t blocks = 0;
  const auto compute = [&](const std::vector<Stretch>& stretches, std::uint64_t more) {
    blocks += more;
    progress.blocks_total = blocks;
    progress.trials_total += own.shard.count == 1 ? trials_of(own, stretches) : more * own.block_trials;
    if (!std::exchange(is_recorded, true)) {
      writer.record([&progress, workers = queue.workers(), begin] {
        return record_of(progress, workers, core::seconds_since(begin));
      });
    }
    run.compute(stretches);
  };
  if (study.stop) {
    const Stored stored(writer);
    StopRounds rounds(study, plan, own, stored);
    for (auto round = run.present(); !round.empty() && !stop.load(); round = rounds.next()) {
      std::uint64_t more = 0;
      for (const Stretch& stretch : round) more += stretch.end - stretch.first;
      compute(round, more);
    }
  } else {
    compute(run.everything(), own.blocks());
  }

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
  provenance.threads = static_cast<unsigned>(queue.workers());
  provenance.wall_time_s.emplace_back("compute", core::seconds_since(begin));
  results::complete(provenance);
  progress.is_writing = true;
  writer.seal(provenance);
  return outcome;
}

}  // namespace ridgeloc::studies
