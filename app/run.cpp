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
#include "app/disk_room.hpp"
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
#include "results/store/result_claim.hpp"
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

/// A study, and where its result goes.
struct Request {
  studies::Study study;
  fs::path output;
};

std::vector<Request> read_requests(const RunOptions& options) {
  std::vector<Request> requests;
  std::set<fs::path> outputs;
  for (const std::string& name : options.study.studies) {
    studies::Study study = studies::read_study(studies::find_study(name), options.study.overrides);
    const fs::path output = link_target(output_path(options, study.name));
    if (!outputs.insert(output).second) {
      throw core::InputError(
          fmt::format("{}: two studies would write this result; run them apart with -o", output.string()));
    }
    requests.push_back({std::move(study), output});
  }
  return requests;
}

Job job_of(const Request& request, const RunOptions& options) {
  return continued(request.study, request.output, options.study.isa, options.shard);
}

/// Refuses what cannot go on before anything is computed, and makes the folder.
void check(const std::vector<Request>& requests, const RunOptions& options) {
  // Of a single study nothing comes before it.
  if (requests.size() > 1)
    for (const Request& request : requests) static_cast<void>(job_of(request, options));
  // A folder is made only after every study has been found good.
  const fs::path folder(options.output);
  if (requests.size() > 1 || !folder.has_filename()) require_folder(folder);
  for (const Request& request : requests) results::require_writable(request.output);
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
    say(fmt::format("{}: was asked for {} trials per cell before; all stay\n", job.output.string(), header.trials));
  }
  const std::uint64_t cells = header.cells.size() - job.assignment.cells.size();
  const std::uint64_t methods = job.study.methods.size() - asked_methods(job);
  std::vector<std::string> more;
  if (cells > 0) more.push_back(results::count_text(cells, "cell"));
  if (methods > 0) more.push_back(results::count_text(methods, "method"));
  if (more.empty()) return;
  say(fmt::format("{}: has {} besides what was asked for; {}\n", job.output.string(), fmt::join(more, " and "),
                  cells + methods == 1 ? "it stays" : "they stay"));
}

/// Of which trials the values are kept, where it is not all of them.
void print_kept(const Job& job) {
  const std::uint64_t kept = job.plan.header.kept_trials;
  // A stop rule may need as many as it allows.
  const std::uint64_t most = job.study.stop ? job.study.stop->max_trials : job.plan.header.trials;
  if (kept == 0 && job.study.trial_columns_mib > 0.0)
    say(fmt::format("{}: keeps no values of single trials: {}\n", job.study.name, too_small_text(job.study, job.plan)));
  if (kept == 0 || kept >= most) return;
  say(
      fmt::format("{}: keeps the values of the first {} of {}{} trials of each cell, at most {:g} MiB in all ([store] "
                  "trial_columns_mib)\n",
                  job.study.name, kept, job.study.stop ? "at most " : "", most, job.study.trial_columns_mib));
}

/// Of how many trials the sealed result loses the values.
void print_dropped(const Job& job) {
  if (!results::path_exists(job.output)) return;
  const results::Header there = results::read_result_header(job.output);
  const std::uint64_t most = job.study.stop ? job.study.stop->max_trials : there.trials;
  const std::uint64_t before = std::min(there.kept_trials, most);
  const std::uint64_t kept = std::min(job.plan.header.kept_trials, before);
  if (kept == before) return;
  say(
      fmt::format("{}: drops the values of {} trials per cell, of up to {} that are there; a larger [store] "
                  "trial_columns_mib keeps them\n",
                  job.output.string(), before - kept, before));
}

/// Where finished blocks are: " in r.h5 and r.h5.parts".
std::string kept_in(const fs::path& output) {
  std::vector<std::string> places;
  for (const fs::path& path : {output, results::parts_folder(output)})
    if (results::path_exists(path)) places.push_back(path.string());
  return places.empty() ? "" : fmt::format(" in {}", fmt::join(places, " and "));
}

/// Cells that have not reached the target of the stop rule.
void print_unmet(const Job& job) {
  const results::Summary summary = results::read_result(job.output);
  if (!studies::unmet_cells(*job.study.stop, summary).empty())
    say(fmt::format("{}: {}\n", job.study.name, reached_text(*job.study.stop, summary)));
}

/// That a name cannot be printed does not end the studies after it. The program says so at its end.
void print_name(const fs::path& result) {
  try {
    fmt::print("{}\n", result.string());
    finish_standard_output();
  } catch (const std::exception&) {
    return;
  }
}

/// Runs one study; returns false when it was stopped before the end.
bool run_job(const Request& request, const RunOptions& options, const std::atomic<bool>& stop) {
  // What is there is looked at when nobody else can change it any more: another run may have made or widened it while
  // this study waited for its turn.
  results::ResultClaim claim(request.output);
  if (!claim.lock_failure().empty()) {
    say(fmt::format("warning: {}: this file system has no locks ({}); see to it that no other run writes this result\n",
                    request.output.string(), claim.lock_failure()));
  }
  const Job job = job_of(request, options);
  const int threads = options.study.threads;
  print_surplus(job);
  print_kept(job);
  print_dropped(job);
  for (const std::string& remark : job.plan.remarks) say(fmt::format("{}: note: {}\n", job.study.name, remark));
  const auto begin = std::chrono::steady_clock::now();
  studies::RunProgress progress;
  studies::RunOutcome outcome;
  try {
    results::ResultWriter writer = studies::writer_of(job.study, job.plan, std::move(claim));
    require_room(job, writer);
    const ProgressDisplay display(job.study.name, progress, job.study.stop.has_value());
    outcome = studies::run_study(job.study, job.plan, job.assignment, writer, *studies::thread_queue(threads),
                                 build_provenance(), progress, stop);
  } catch (const core::IoError& error) {
    const fs::path parts = results::parts_folder(job.output);
    const std::string kept =
        results::path_exists(parts) ? fmt::format("finished parts are kept in {}; ", parts.string()) : "";
    throw core::IoError(fmt::format("{} ({}the same command goes on from there)", error.what(), kept));
  }
  for (const std::string& warning : outcome.warnings) say(fmt::format("warning: {}\n", warning));
  const std::uint64_t blocks = progress.blocks_total;
  if (!outcome.sealed) {
    say(fmt::format("{}: stopped; {} of {} blocks are kept{}. The same command goes on from there.\n", job.study.name,
                    outcome.blocks_kept, blocks, kept_in(job.output)));
    return false;
  }
  if (outcome.unchanged) {
    say(fmt::format("{}: complete already, nothing to do\n", job.output.string()));
  } else {
    if (outcome.blocks_found > 0) {
      say(fmt::format("{}: {} of {} blocks were there from an earlier run\n", job.study.name, outcome.blocks_found,
                      blocks));
    }
    const studies::Shard& shard = job.assignment.shard;
    const std::string trials = job.study.stop
                                   ? fmt::format("{} to {}", job.study.stop->min_trials, job.study.stop->max_trials)
                                   : std::to_string(job.assignment.trials);
    const std::string methods =
        job.study.methods.empty() ? "" : fmt::format(", {}", results::count_text(asked_methods(job), "method"));
    say(fmt::format("{}: {}, {} trials each{} on {} with {}{}: {}\n", job.study.name,
                    results::count_text(job.assignment.cells.size(), "cell"), trials, methods,
                    results::count_text(static_cast<std::uint64_t>(threads), "thread"), job.plan.header.isa,
                    shard.count == 1 ? "" : fmt::format(", share {} of {}", shard.number, shard.count),
                    duration_text(core::seconds_since(begin))));
    if (job.study.stop) print_unmet(job);
  }
  print_name(job.output);
  return true;
}

}  // namespace

int run(const RunOptions& options) {
  const std::vector<Request> requests = read_requests(options);
  check(requests, options);
  const std::atomic<bool>& stop = stop_on_signals();
  std::optional<TimeLimit> limit;
  if (options.time_limit_s) limit.emplace(*options.time_limit_s);
  for (const Request& request : requests) {
    if (!run_job(request, options, stop)) return Stopped;
  }
  return Success;
}

}  // namespace ridgeloc::app
