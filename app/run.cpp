#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <set>
#include <vector>

#include "app/build_info.hpp"
#include "app/duration.hpp"
#include "app/exit_code.hpp"
#include "app/instruction_set.hpp"
#include "app/interrupt.hpp"
#include "app/output.hpp"
#include "app/progress.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "results/file_system.hpp"
#include "results/result_file.hpp"
#include "results/result_writer.hpp"
#include "studies/runner.hpp"
#include "studies/study_reader.hpp"

namespace ridgeloc::app {

namespace {

namespace fs = std::filesystem;

struct Job {
  studies::Study study;
  studies::Plan plan;
  fs::path output;
  bool complete = false;  ///< the result is there already
};

/// Where the result of a study goes: -o names a file for one study, a folder for several.
fs::path output_path(const RunOptions& options, const std::string& study_name) {
  const fs::path given(options.output);
  const std::string file = study_name + ".h5";
  if (given.empty()) return file;
  std::error_code unknown;
  const bool folder = options.study.studies.size() > 1 || fs::is_directory(given, unknown) || !given.has_filename();
  return folder ? given / file : given;
}

/// What to compute a result with: what the user asked for, or what a stopped run of it has begun with.
core::Isa isa_of(const RunOptions& options, const fs::path& output) {
  const auto begun = results::isa_of_unfinished(output);
  if (!options.study.isa.empty() || !begun) return instruction_set(options.study.isa);
  const auto isa = core::find_isa(*begun);
  if (isa && core::is_supported(*isa)) return *isa;
  throw core::InputError(
      fmt::format("{}.parts was begun with the instruction set {}, which this processor lacks; go on where it began, "
                  "delete the folder, or choose another -o",
                  output.string(), *begun));
}

/// Whether the result is there already. A result of another study is never overwritten.
bool already_there(const RunOptions& options, const Job& job) {
  if (!path_exists(job.output)) return false;
  const results::Header header = results::read_result_header(job.output);
  if (!options.study.isa.empty() && options.study.isa != header.isa) {
    throw core::InputError(fmt::format("{}: was computed with the instruction set {}; choose another -o or --isa {}",
                                       job.output.string(), header.isa, header.isa));
  }
  if (header.study_toml == job.plan.header.study_toml) return true;
  const std::string difference = header.study_hash != job.plan.header.study_hash
                                     ? "another study"
                                     : "the same study with other trials, sweep, methods or figures";
  throw core::InputError(fmt::format("{}: holds {}; choose another -o or remove it", job.output.string(), difference));
}

std::vector<Job> make_jobs(const RunOptions& options) {
  std::vector<Job> jobs;
  std::set<fs::path> outputs;
  for (const std::string& name : options.study.studies) {
    studies::Study study = studies::read_study(studies::find_study(name), options.study.overrides);
    const fs::path output = output_path(options, study.name);
    studies::Plan plan = studies::make_plan(study, isa_of(options, output));
    if (!outputs.insert(output).second) {
      throw core::InputError(
          fmt::format("{}: two studies would write this result; run them apart with -o", output.string()));
    }
    jobs.push_back({std::move(study), std::move(plan), output});
  }
  for (Job& job : jobs) job.complete = already_there(options, job);
  // A folder is made only after every study has been found good.
  const fs::path folder(options.output);
  if (jobs.size() > 1 || !folder.has_filename()) require_folder(folder);
  for (const Job& job : jobs) results::require_writable(job.output);
  return jobs;
}

/// Runs one study; returns false when it was stopped before the end.
bool run_job(const Job& job, int threads, const std::atomic<bool>& stop) {
  if (job.complete) {
    fmt::print(stderr, "{}: complete already, nothing to do\n", job.output.string());
    if (path_exists(job.output.string() + ".parts")) {
      fmt::print(stderr, "warning: {}.parts is left over from an earlier run and may be removed\n",
                 job.output.string());
    }
    fmt::print("{}\n", job.output.string());
    return true;
  }
  const std::uint64_t blocks = job.plan.blocks_per_cell * job.plan.cells.size();
  const auto begin = std::chrono::steady_clock::now();
  studies::RunProgress progress;
  studies::RunOutcome outcome;
  try {
    const ProgressDisplay display(job.study.name, progress, blocks);
    outcome = studies::run_study(job.study, job.plan, job.output, threads, build_provenance(), progress, stop);
  } catch (const core::IoError& error) {
    const std::string parts = job.output.string() + ".parts";
    const std::string kept = path_exists(parts) ? fmt::format("finished parts are kept in {}; ", parts) : "";
    throw core::IoError(fmt::format("{} ({}the same command goes on from there)", error.what(), kept));
  }
  for (const std::string& warning : outcome.warnings) fmt::print(stderr, "warning: {}\n", warning);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (!outcome.sealed) {
    fmt::print(stderr, "{}: stopped; {} of {} blocks are kept in {}.parts. The same command goes on from there.\n",
               job.study.name, outcome.blocks_found + outcome.blocks_run, blocks, job.output.string());
    return false;
  }
  if (outcome.blocks_found > 0) {
    fmt::print(stderr, "{}: {} of {} blocks were there from an earlier run\n", job.study.name, outcome.blocks_found,
               blocks);
  }
  fmt::print(stderr, "{}: {} cell{}, {} trials each, {} method{} on {} thread{} with {}: {}\n", job.study.name,
             job.plan.cells.size(), job.plan.cells.size() == 1 ? "" : "s", job.study.trials, job.study.methods.size(),
             job.study.methods.size() == 1 ? "" : "s", threads, threads == 1 ? "" : "s", job.plan.header.isa,
             duration_text(seconds));
  fmt::print("{}\n", job.output.string());
  finish_standard_output();
  return true;
}

}  // namespace

int run(const RunOptions& options) {
  const std::vector<Job> jobs = make_jobs(options);
  const std::atomic<bool>& stop = stop_on_signals();
  for (const Job& job : jobs) {
    if (!run_job(job, options.study.threads, stop)) return Stopped;
  }
  return Success;
}

}  // namespace ridgeloc::app
