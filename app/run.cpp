#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "app/build_info.hpp"
#include "app/continuation.hpp"
#include "app/duration.hpp"
#include "app/exit_code.hpp"
#include "app/interrupt.hpp"
#include "app/output.hpp"
#include "app/progress.hpp"
#include "app/stop_text.hpp"
#include "app/verbs.hpp"
#include "core/elapsed.hpp"
#include "core/error.hpp"
#include "results/schema/text.hpp"
#include "results/store/parts_folder.hpp"
#include "results/store/result_file.hpp"
#include "results/util/file_system.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "studies/run/runner.hpp"
#include "studies/study/unmet_cells.hpp"

namespace ridgeloc::app {

namespace {

namespace fs = std::filesystem;

/// Where the result of a study goes: -o names a file for one study, a folder for several.
fs::path output_path(const RunOptions& options, const std::string& study_name) {
  const fs::path given(options.output);
  const studies::Shard& shard = options.shard;
  const std::string share = shard.count == 1 ? "" : fmt::format(".shard-{}-of-{}", shard.number, shard.count);
  const std::string file = study_name + share + ".h5";
  if (given.empty()) return file;
  std::error_code unknown;
  const bool folder = options.study.studies.size() > 1 || fs::is_directory(given, unknown) || !given.has_filename();
  return folder ? given / file : given;
}

std::vector<Job> make_jobs(const RunOptions& options) {
  std::vector<Job> jobs;
  std::set<fs::path> outputs;
  for (const std::string& name : options.study.studies) {
    studies::Study study = studies::read_study(studies::find_study(name), options.study.overrides);
    const fs::path output = link_target(output_path(options, study.name));
    if (!outputs.insert(output).second) {
      throw core::InputError(
          fmt::format("{}: two studies would write this result; run them apart with -o", output.string()));
    }
    jobs.push_back(continued(std::move(study), output, options.study.isa, options.shard));
  }
  // A folder is made only after every study has been found good.
  const fs::path folder(options.output);
  if (jobs.size() > 1 || !folder.has_filename()) require_folder(folder);
  for (const Job& job : jobs) results::require_writable(job.output);
  return jobs;
}

/// Methods of [[method]] that were asked for: neither the scene's label nor differences.
std::uint64_t asked_methods(const Job& job) {
  return static_cast<std::uint64_t>(
      std::ranges::count_if(job.assignment.methods, [&](std::size_t m) { return m < job.study.methods.size(); }));
}

/// What the result has beyond what was asked for; it stays.
void print_surplus(const Job& job) {
  const results::Header& header = job.plan.header;
  if (header.trials > job.assignment.trials) {
    fmt::print(stderr, "{}: was asked for {} trials per cell before; all stay\n", job.output.string(), header.trials);
  }
  const std::uint64_t cells = header.cells.size() - job.assignment.cells.size();
  const std::uint64_t methods = job.study.methods.size() - asked_methods(job);
  if (cells + methods > 0) {
    fmt::print(stderr, "{}: has {} and {} besides those asked for; they stay\n", job.output.string(),
               results::count_text(cells, "cell"), results::count_text(methods, "method"));
  }
}

/// Where finished blocks are: " in r.h5 and r.h5.parts".
std::string kept_in(const fs::path& output) {
  std::vector<std::string> places;
  for (const fs::path& path : {output, results::parts_folder(output)})
    if (path_exists(path)) places.push_back(path.string());
  return places.empty() ? "" : fmt::format(" in {}", fmt::join(places, " and "));
}

/// Cells that have not reached the target of the stop rule.
void print_unmet(const Job& job) {
  const results::Summary summary = results::read_result(job.output);
  if (!studies::unmet_cells(*job.study.stop, summary).empty())
    fmt::print(stderr, "{}: {}\n", job.study.name, reached_text(*job.study.stop, summary));
}

/// Runs one study; returns false when it was stopped before the end.
bool run_job(const Job& job, int threads, const std::atomic<bool>& stop) {
  print_surplus(job);
  const auto begin = std::chrono::steady_clock::now();
  studies::RunProgress progress;
  studies::RunOutcome outcome;
  try {
    const ProgressDisplay display(job.study.name, progress);
    outcome = studies::run_study(job.study, job.plan, job.assignment, job.output, *studies::thread_queue(threads),
                                 build_provenance(), progress, stop);
  } catch (const core::IoError& error) {
    const fs::path parts = results::parts_folder(job.output);
    const std::string kept = path_exists(parts) ? fmt::format("finished parts are kept in {}; ", parts.string()) : "";
    throw core::IoError(fmt::format("{} ({}the same command goes on from there)", error.what(), kept));
  }
  for (const std::string& warning : outcome.warnings) fmt::print(stderr, "warning: {}\n", warning);
  const std::uint64_t blocks = progress.blocks_total;
  if (!outcome.sealed) {
    fmt::print(stderr, "{}: stopped; {} of {} blocks are kept{}. The same command goes on from there.\n",
               job.study.name, outcome.blocks_kept, blocks, kept_in(job.output));
    return false;
  }
  if (outcome.unchanged) {
    fmt::print(stderr, "{}: complete already, nothing to do\n", job.output.string());
  } else {
    if (outcome.blocks_found > 0) {
      fmt::print(stderr, "{}: {} of {} blocks were there from an earlier run\n", job.study.name, outcome.blocks_found,
                 blocks);
    }
    const studies::Shard& shard = job.assignment.shard;
    const std::string trials = job.study.stop
                                   ? fmt::format("{} to {}", job.study.stop->min_trials, job.study.stop->max_trials)
                                   : std::to_string(job.assignment.trials);
    const std::string methods =
        job.study.methods.empty() ? "" : fmt::format(", {}", results::count_text(asked_methods(job), "method"));
    fmt::print(stderr, "{}: {}, {} trials each{} on {} with {}{}: {}\n", job.study.name,
               results::count_text(job.assignment.cells.size(), "cell"), trials, methods,
               results::count_text(static_cast<std::uint64_t>(threads), "thread"), job.plan.header.isa,
               shard.count == 1 ? "" : fmt::format(", share {} of {}", shard.number, shard.count),
               duration_text(core::seconds_since(begin)));
    if (job.study.stop) print_unmet(job);
  }
  fmt::print("{}\n", job.output.string());
  finish_standard_output();
  return true;
}

}  // namespace

int run(const RunOptions& options) {
  const std::vector<Job> jobs = make_jobs(options);
  const std::atomic<bool>& stop = stop_on_signals();
  std::optional<TimeLimit> limit;
  if (options.time_limit_s) limit.emplace(*options.time_limit_s);
  for (const Job& job : jobs) {
    if (!run_job(job, options.study.threads, stop)) return Stopped;
  }
  return Success;
}

}  // namespace ridgeloc::app
