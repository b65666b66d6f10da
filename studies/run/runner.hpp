#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "results/store/provenance.hpp"
#include "results/store/result_claim.hpp"
#include "results/store/result_writer.hpp"
#include "studies/plan/assignment.hpp"
#include "studies/plan/plan.hpp"
#include "studies/run/work_queue.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// How far a run is. Written by the workers, read by whoever shows it; atomics alone, no lock.
struct RunProgress {
  std::atomic<std::uint64_t> blocks_total{0};  ///< as far as is known: a stop rule decides on the way
  std::atomic<std::uint64_t> blocks_done{0};   ///< blocks of this run and those found finished
  std::atomic<std::uint64_t> trials_total{0};  ///< of these blocks; last blocks may be smaller
  std::atomic<std::uint64_t> trials_done{0};   ///< trials of this run, those of blocks that are under way included
  std::atomic<std::uint64_t> trials_found{0};  ///< trials of blocks found finished
  std::atomic<bool> is_writing{false};         ///< all trials are there, and the result is being written
};

struct RunOutcome {
  bool sealed = false;             ///< false: stopped before the end, finished blocks kept
  bool unchanged = false;          ///< the result had everything already
  std::uint64_t blocks_found = 0;  ///< finished by an earlier run, as far as this one has come
  std::uint64_t blocks_run = 0;
  std::uint64_t blocks_kept = 0;  ///< of a stopped run: finished ones of the assignment, by this run or earlier ones
  std::vector<std::string> warnings;  ///< one line per damaged part that was found and is computed again
};

/// Computes every block of an assignment that the result does not have yet, for the methods that lack it, by the
/// workers of a queue, and seals the result with all that it has. A stop rule is applied in rounds that depend on
/// finished blocks alone (`StopRounds`), so that neither threads nor interruptions change where a cell ends.
///
/// Blocks are taken in rounds over the cells (`BlockRounds`), so that a run that is stopped has something of every
/// cell. They are independent; what a block holds does not depend on the number of workers or on the order. When `stop`
/// becomes true, blocks that are under way are given up, finished ones are kept, and the result stays as it was.
/// `provenance` carries what the caller knows about the build; the runner adds threads and wall times. How far the run
/// is can be read beside it (`results::RunRecord`). The writer is one of the plan's header, with a stop rule one that
/// keeps totals. Throws core::InputError if what is there of the result is of
/// another study, core::IoError if writing fails; finished parts are kept.
RunOutcome run_study(const Study& study, const Plan& plan, const Assignment& assignment, results::ResultWriter& writer,
                     WorkQueue& queue, results::Provenance provenance, RunProgress& progress,
                     const std::atomic<bool>& stop);

/// The same with a writer of its own.
RunOutcome run_study(const Study& study, const Plan& plan, const Assignment& assignment, results::ResultClaim output,
                     WorkQueue& queue, results::Provenance provenance, RunProgress& progress,
                     const std::atomic<bool>& stop);

/// The writer that a run of the study needs.
results::ResultWriter writer_of(const Study& study, const Plan& plan, results::ResultClaim output);

}  // namespace ridgeloc::studies
