#include "app/disk_room.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <system_error>
#include <vector>

#include "app/output.hpp"
#include "core/error.hpp"
#include "results/store/parts_folder.hpp"
#include "studies/plan/plan.hpp"
#include "studies/run/pilot.hpp"
#include "studies/study/stop_rule.hpp"

namespace ridgeloc::app {

namespace {

namespace fs = std::filesystem;

/// What the totals of one method in one cell take, about: 10 to 20 thousand bytes, by the spread of its histograms.
constexpr double bytes_of_totals = 20e3;

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// What a run has still to compute: all that it was asked for, with a stop rule for those cells alone that are not
/// known well enough.
studies::Assignment work_of(const Job& job, const results::ResultWriter& writer) {
  studies::Assignment work = job.assignment;
  if (!job.study.stop) return work;
  work.trials = job.study.stop->max_trials;
  std::erase_if(work.cells, [&](std::size_t cell) {
    std::vector<results::Statistics> statistics;
    for (std::size_t m = 0; m < job.plan.header.methods.size(); ++m) statistics.push_back(writer.statistics(cell, m));
    const auto trials = std::ranges::max(statistics, {}, &results::Statistics::trials).trials;
    return trials >= job.study.stop->min_trials &&
           studies::precision_of(*job.study.stop, job.plan.header, statistics).is_enough();
  });
  return work;
}

/// Bytes of the values of one trial, by method, by having one computed.
std::vector<double> bytes_of_trial(const Job& job) {
  const studies::Pilot pilot = studies::run_pilot(job.study, job.plan, 0.0, *studies::thread_queue(1));
  std::vector<double> bytes(job.plan.header.methods.size(), 0.0);
  for (const results::TrialColumns& columns : pilot.columns)
    bytes[columns.method] = static_cast<double>(columns.value_bytes());
  return bytes;
}

/// What a result lacks, over all methods.
struct Missing {
  std::uint64_t blocks = 0;  ///< of methods that lack them, or the values of their trials
  double totals = 0.0;       ///< bytes, digests of blocks among them
  double values = 0.0;       ///< bytes
};

std::uint64_t difference(std::uint64_t all, std::uint64_t there) {
  return all - std::min(all, there);
}

Missing missing_of(const Job& job, const studies::Assignment& work, const results::ResultWriter& writer) {
  const std::uint64_t kept = std::min(work.trials, job.plan.header.kept_trials);
  const std::uint64_t kept_blocks = (kept + work.block_trials - 1) / work.block_trials;
  const std::vector<double> bytes = kept > 0 ? bytes_of_trial(job) : std::vector<double>();
  Missing missing;
  for (const std::size_t method : work.methods) {
    const double bytes_per_trial = kept > 0 ? bytes[method] : 0.0;
    std::uint64_t there = 0, values_there = 0, cells_new = 0;
    for (const std::size_t cell : work.cells) {
      const std::uint64_t blocks = writer.blocks_there(cell, work.trials, {method});
      there += blocks;
      cells_new += blocks == 0 ? 1 : 0;
      values_there += writer.values_there(cell, kept, method);
    }
    const std::uint64_t blocks = difference(work.blocks(), there);
    const std::uint64_t values = bytes_per_trial > 0.0 ? difference(work.blocks(kept_blocks), values_there) : 0;
    missing.blocks += std::max(blocks, values);
    missing.totals += static_cast<double>(std::min(cells_new, blocks)) * bytes_of_totals;
    missing.totals += static_cast<double>(blocks) * bytes_per_block;
    // The last block of a cell may be kept in part.
    if (values > 0)
      missing.values +=
          static_cast<double>(values) * static_cast<double>(kept) / static_cast<double>(kept_blocks) * bytes_per_trial;
  }
  return missing;
}

/// All that a run may write, at most.
double most_bytes(const Job& job, const studies::Assignment& work) {
  const auto cells = static_cast<double>(work.cells.size());
  const auto methods = static_cast<double>(work.methods.size());
  const auto kept = static_cast<double>(std::min(work.trials, job.plan.header.kept_trials));
  const double digests = static_cast<double>(work.blocks_per_cell()) * bytes_per_block;
  return cells *
         (methods * (bytes_of_totals + digests) + kept * static_cast<double>(studies::bytes_per_trial(job.study)));
}

}  // namespace

std::string size_text(double bytes) {
  constexpr std::array<const char*, 5> units = {"KiB", "MiB", "GiB", "TiB", "PiB"};
  double size = bytes / 1024.0;
  std::size_t unit = 0;
  for (; size >= 999.5 && unit + 1 < units.size(); ++unit) size /= 1024.0;
  return fmt::format("{:.3g} {}", size, units[unit]);
}

double free_bytes(const fs::path& folder) {
  std::error_code unknown;
  const fs::space_info space = fs::space(folder, unknown);
  return unknown ? std::numeric_limits<double>::infinity() : static_cast<double>(space.available);
}

void require_room(const Job& job, const results::ResultWriter& writer) {
  const double free = free_bytes(folder_of(job.output));
  const auto there = static_cast<double>(results::stored_bytes(job.output));
  const studies::Assignment work = work_of(job, writer);
  if (2.0 * most_bytes(job, work) + there <= free) return;

  const Missing missing = missing_of(job, work, writer);
  if (missing.blocks == 0) return;
  const double needed = missing.totals + missing.values;
  const std::string found = fmt::format(
      "{}: takes about {}{}, {} of it values of single trials ([store] trial_columns_mib), and {} are free",
      job.output.string(), size_text(needed), there > 0.0 ? " more" : "", size_text(missing.values), size_text(free));
  if (needed > free) throw core::InputError(found + "; make room, keep fewer trials, or choose another -o");
  if (2.0 * needed + there > free)
    say(fmt::format("warning: {}; until its parts are sealed it takes {} more\n", found, size_text(needed + there)));
}

}  // namespace ridgeloc::app
