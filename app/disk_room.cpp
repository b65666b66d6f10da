#include "app/disk_room.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <map>
#include <system_error>
#include <utility>
#include <vector>

#include "app/output.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "results/store/parts_folder.hpp"
#include "studies/plan/plan.hpp"
#include "studies/run/pilot.hpp"
#include "studies/run/stop_rounds.hpp"
#include "studies/study/capabilities.hpp"
#include "studies/study/stop_rule.hpp"

namespace ridgeloc::app {

namespace {

namespace fs = std::filesystem;

/// What a row of the ledger takes with its share of the summary, at most about: the spread of its histograms decides.
constexpr double bytes_of_row = 20e3;

/// For the trials from which room is forecast where it may be too little.
constexpr double forecast_budget_s = 0.2;

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

/// What a result lacks, over all methods.
struct Missing {
  std::uint64_t blocks = 0;  ///< of methods that lack them, or the values of their trials
  double totals = 0.0;       ///< bytes, digests of blocks among them
  double values = 0.0;       ///< bytes, as they are before any is compressed
};

std::uint64_t difference(std::uint64_t all, std::uint64_t there) {
  return all - std::min(all, there);
}

Missing missing_of(const Job& job, const studies::Assignment& work, const results::ResultWriter& writer,
                   const std::vector<double>& bytes_of_trial, double bytes_of_totals) {
  const std::uint64_t kept = std::min(work.trials, job.plan.header.kept_trials);
  const std::uint64_t kept_blocks = (kept + work.block_trials - 1) / work.block_trials;
  Missing missing;
  for (const std::size_t method : work.methods) {
    std::uint64_t there = 0, values_there = 0, cells_new = 0;
    for (const std::size_t cell : work.cells) {
      const std::uint64_t blocks = writer.blocks_there(cell, work.trials, {method});
      there += blocks;
      cells_new += blocks == 0 ? 1 : 0;
      values_there += writer.values_there(cell, kept, method);
    }
    const std::uint64_t blocks = difference(work.blocks(), there);
    const std::uint64_t values = bytes_of_trial[method] > 0.0 ? difference(work.blocks(kept_blocks), values_there) : 0;
    missing.blocks += std::max(blocks, values);
    missing.totals += static_cast<double>(std::min(cells_new, blocks)) * bytes_of_totals;
    missing.totals += static_cast<double>(blocks) * bytes_per_block;
    // The last block of a cell may be kept in part.
    if (values > 0)
      missing.values += static_cast<double>(values) * static_cast<double>(kept) / static_cast<double>(kept_blocks) *
                        bytes_of_trial[method];
  }
  return missing;
}

/// Trials of all cells together that a limited cost allows, at most, as the trials of a pilot let expect: the first
/// look of every cell is free, and the last step of one may go a fifth beyond the limit.
double affordable_trials(const Job& job, const studies::Pilot& pilot) {
  std::map<std::size_t, double> costs;  // of a trial, by cell
  for (const results::Row& row : pilot.rows) {
    if (!studies::has_cost(job.study, job.plan.header, row.method)) continue;
    costs[row.cell] += studies::cost_of(*job.study.experiment, job.plan.cells[row.cell].values, row.statistics) /
                       static_cast<double>(row.statistics.trials);
  }
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [cell, cost] : costs) least = std::min(least, cost);
  const auto free = static_cast<double>(job.plan.cells.size() * job.study.stop->min_trials);
  return free + 1.2 * job.study.stop->max_cost / least;
}

/// Runs of blocks that are not merged with their neighbours, at most.
double most_rows(std::uint64_t blocks) {
  return static_cast<double>(std::bit_width(blocks));
}

/// All that a run may write, at most.
double most_bytes(const Job& job, const studies::Assignment& work) {
  const auto cells = static_cast<double>(work.cells.size());
  const auto methods = static_cast<double>(work.methods.size());
  const auto kept = static_cast<double>(std::min(work.trials, job.plan.header.kept_trials));
  const double digests = static_cast<double>(work.blocks_per_cell()) * bytes_per_block;
  const double totals = most_rows(work.blocks_per_cell()) * bytes_of_row + digests;
  return cells * (methods * totals + kept * static_cast<double>(studies::bytes_per_trial(job.study)));
}

}  // namespace

std::string size_text(double bytes) {
  constexpr std::array<const char*, 5> units = {"KiB", "MiB", "GiB", "TiB", "PiB"};
  double size = bytes / 1024.0;
  std::size_t unit = 0;
  for (; size >= 999.5 && unit + 1 < units.size(); ++unit) size /= 1024.0;
  return fmt::format("{:.3g} {}", size, units[unit]);
}

std::string too_small_text(const studies::Study& study, const studies::Plan& plan) {
  const double least = static_cast<double>(studies::bytes_per_trial(study) * plan.cells.size());
  return fmt::format("one of each cell takes {}, [store] trial_columns_mib allows {}", size_text(least),
                     size_text(study.trial_columns_mib * core::mebibyte));
}

double free_bytes(const fs::path& folder) {
  std::error_code unknown;
  const fs::space_info space = fs::space(folder, unknown);
  return unknown ? std::numeric_limits<double>::infinity() : static_cast<double>(space.available);
}

WritingForecast writing_forecast(const studies::Study& study, const studies::Plan& plan,
                                 const std::vector<results::Row>& rows, std::vector<results::TrialColumns> columns,
                                 const std::vector<std::uint64_t>& cell_trials) {
  if (plan.header.kept_trials == 0) columns.clear();
  WritingForecast forecast;
  try {
    forecast.cost = results::try_writing(plan.header, rows, std::move(columns), cell_trials);
  } catch (const core::IoError& error) {
    // Not even a full disk for temporary files keeps from the rest of a plan, nor from a run elsewhere.
    forecast.not_tried = error.what();
    const std::uint64_t most = std::ranges::max(cell_trials);
    const double ledger_rows = most_rows((most + plan.header.block_trials - 1) / plan.header.block_trials);
    forecast.cost.per_cell.bytes = ledger_rows * bytes_of_row * static_cast<double>(plan.header.methods.size());
    forecast.cost.per_cell.part_bytes = forecast.cost.per_cell.bytes;
    forecast.cost.per_byte = {0.0, 1.0, 1.0};
    forecast.cost.bytes_per_trial = static_cast<double>(studies::bytes_per_trial(study));
  }
  return forecast;
}

void require_room(const Job& job, const results::ResultWriter& writer) {
  const double free = free_bytes(folder_of(job.output));
  const auto there = static_cast<double>(results::stored_bytes(job.output));
  const studies::Assignment work = work_of(job, writer);
  if (2.0 * most_bytes(job, work) + there <= free) return;

  studies::Pilot pilot = studies::run_pilot(job.study, job.plan, forecast_budget_s, *studies::thread_queue(1));
  std::vector<double> bytes_of_trial(job.plan.header.methods.size(), 0.0);
  if (job.plan.header.kept_trials > 0) {
    for (const results::TrialColumns& columns : pilot.columns)
      bytes_of_trial[columns.method] = static_cast<double>(columns.value_bytes()) / static_cast<double>(columns.trials);
  }
  const bool has_limited_cost = job.study.stop && job.study.stop->max_cost > 0.0;
  const double most_trials = has_limited_cost ? affordable_trials(job, pilot) : std::numeric_limits<double>::infinity();
  const std::vector<std::uint64_t> trials(job.plan.cells.size(), work.trials);
  const results::WritingCost cost =
      writing_forecast(job.study, job.plan, pilot.rows, std::move(pilot.columns), trials).cost;
  const double of_method = cost.per_cell.bytes / static_cast<double>(job.plan.header.methods.size());
  const Missing missing = missing_of(job, work, writer, bytes_of_trial, of_method);
  if (missing.blocks == 0) return;
  const double uncompressed = std::min(missing.values, most_trials * cost.bytes_per_trial);
  const double values = uncompressed * cost.per_byte.bytes;
  const double result = missing.totals + values;
  const double parts = missing.totals + uncompressed * cost.per_byte.part_bytes;
  const std::string found = fmt::format(
      "{}: takes about {}{}, {} of it values of single trials ([store] trial_columns_mib), {} in parts before that, "
      "and {} are free",
      job.output.string(), size_text(result), there > 0.0 ? " more" : "", size_text(values), size_text(parts),
      size_text(free));
  if (std::max(result, parts) > free)
    throw core::InputError(found + "; make room, keep fewer trials, or choose another -o");
  if (result + parts + there > free)
    say(fmt::format("warning: {}; both are there for a while when the parts are sealed\n", found));
}

}  // namespace ridgeloc::app
