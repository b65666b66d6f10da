#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "app/continuation.hpp"
#include "app/disk_room.hpp"
#include "app/duration.hpp"
#include "app/exit_code.hpp"
#include "app/instruction_set.hpp"
#include "app/output.hpp"
#include "app/slurm.hpp"
#include "app/stop_text.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "results/schema/text.hpp"
#include "results/store/writing_cost.hpp"
#include "results/util/shell.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "studies/run/pilot.hpp"
#include "studies/study/audit_sample.hpp"
#include "studies/study/axis_groups.hpp"

namespace ridgeloc::app {

namespace {

constexpr double pilot_budget_s = 2.0;

constexpr double share_s = 3600.0;
constexpr double most_sensible_s = 365.25 * 86400.0;
constexpr double most_shares = 1000.0;  // Slurm's arrays end there unless its configuration says otherwise

/// "0.71 us", "15 ms", "2 s".
std::string trial_time_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.3g} us", seconds * 1e6);
  return seconds < 1.0 ? fmt::format("{:.3g} ms", seconds * 1e3) : fmt::format("{:.3g} s", seconds);
}

/// What a plan says of the trials of all cells.
struct Totals {
  double trials = 0.0;
  double kept = 0.0;  ///< of these, trials whose values are kept
  std::uint64_t blocks = 0;
  std::uint64_t least = 0;  ///< per cell
  std::uint64_t most = 0;
};

Totals totals_of(const results::Header& header, const std::vector<std::uint64_t>& cell_trials) {
  Totals totals;
  for (const std::uint64_t n : cell_trials) {
    totals.trials += static_cast<double>(n);
    totals.kept += static_cast<double>(std::min(n, header.kept_trials));
    totals.blocks += (n + header.block_trials - 1) / header.block_trials;
  }
  const auto [least, most] = std::ranges::minmax(cell_trials);
  totals.least = least;
  totals.most = most;
  return totals;
}

/// The axes that one is zipped with.
std::vector<std::string> zipped_with(const studies::Study& study, const std::string& axis) {
  for (std::vector<std::string> names : study.zip)
    if (std::erase(names, axis) > 0) return names;
  return {};
}

void print_contents(const studies::Study& study, const studies::Plan& plan) {
  fmt::print("{}: {}\n", study.name, study.title);
  for (const studies::SweepAxis& axis : study.sweep) {
    const auto others = zipped_with(study, axis.setting->name);
    fmt::print("  axis     {} ({}){}\n", axis.setting->name, results::count_text(axis.values.size(), "value"),
               others.empty() ? "" : fmt::format(", zipped with {}", fmt::join(others, " and ")));
  }
  for (const auto& method : study.methods) fmt::print("  method   {} ({})\n", method.label, method.solver);
  for (const std::string& remark : plan.remarks) fmt::print("  note     {}\n", remark);
  const std::size_t excluded = static_cast<std::size_t>(studies::crossed_cells(study)) - plan.cells.size();
  fmt::print("  cells    {}{}\n", plan.cells.size(), excluded == 0 ? "" : fmt::format(", {} excluded", excluded));
}

void print_trials(const studies::Study& study, const Totals& totals, double most_trials) {
  const std::string per_cell = totals.least == totals.most ? fmt::format("{}", totals.least)
                                                           : fmt::format("{} to {}", totals.least, totals.most);
  fmt::print("  trials   {}{:.0f} ({} per cell){}\n", study.stop ? "about " : "", totals.trials, per_cell,
             study.stop ? fmt::format(", at most {:.0f}", most_trials) : "");
  if (!study.stop) return;
  const studies::StopRule& rule = *study.stop;
  fmt::print("  stop     {}, after {} to {} trials per cell\n", target_text(rule), rule.min_trials, rule.max_trials);
  if (rule.max_cost > 0.0) fmt::print("           or at a cost of {:g} of all cells together\n", rule.max_cost);
}

/// What is kept of single trials, and the room that the result needs.
void print_storage(const studies::Study& study, const studies::Plan& plan, const Totals& totals,
                   const results::WritingCost& cost) {
  const std::uint64_t kept = plan.header.kept_trials;
  const std::string which =
      kept >= totals.most ? std::string("all trials") : fmt::format("the first {} trials of each cell", kept);
  const bool is_too_small = kept == 0 && study.trial_columns_mib > 0.0;
  fmt::print("  kept     {}\n",
             is_too_small ? "no values of single trials: " + too_small_text(study, plan)
             : kept == 0  ? "no values of single trials"
                          : fmt::format("the values of {}: {}, at most {:g} MiB", which,
                                        size_text(totals.kept * cost.bytes_per_trial), study.trial_columns_mib));
  const double digests =
      static_cast<double>(totals.blocks) * static_cast<double>(plan.header.methods.size()) * bytes_per_block;
  const results::WritingCost::Amount amount = cost.of(static_cast<double>(plan.cells.size()), totals.kept);
  const double result = amount.bytes + digests;
  const double parts = amount.part_bytes + digests;
  fmt::print("  disk     about {}, and {} in parts until they are sealed\n", size_text(result), size_text(parts));
  const double free = free_bytes(".");
  if (result + parts > free) fmt::print("  note     only {} are free in this folder\n", size_text(free));
}

/// Prints it and returns the seconds that the study is expected to take.
double print_plan(const studies::Study& study, core::Isa isa, int threads) {
  const studies::Plan plan = studies::make_plan(study, isa);
  const auto cells = static_cast<double>(plan.cells.size());
  // More threads than there are processors would tell nothing of a machine that has them.
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  studies::Pilot pilot =
      studies::run_pilot(study, plan, pilot_budget_s, *studies::thread_queue(std::min(threads, processors)));
  std::vector<std::uint64_t> cell_trials = pilot.predicted_trials;
  if (cell_trials.empty()) cell_trials.assign(plan.cells.size(), study.trials);
  const Totals totals = totals_of(plan.header, cell_trials);
  const double most_trials = study.stop ? static_cast<double>(study.stop->max_trials) * cells : totals.trials;
  const auto [cost, not_reckoned] = writing_forecast(study, plan, pilot.rows, std::move(pilot.columns), cell_trials);

  print_contents(study, plan);
  print_trials(study, totals, most_trials);
  fmt::print("  blocks   {} of {} trials\n", totals.blocks, plan.header.block_trials);
  fmt::print("  pilot    {} per trial and thread, all methods, with {} ({} trials)\n",
             trial_time_text(pilot.seconds_per_trial), plan.header.isa, pilot.trials);
  // A block is the work of one thread, and they are computed in rounds of so many as there are threads.
  const auto busy = static_cast<int>(std::min(static_cast<std::uint64_t>(threads), totals.blocks));
  const auto at_once = static_cast<std::uint64_t>(threads);
  const std::uint64_t rounds = (totals.blocks + at_once - 1) / at_once;
  const double share_of_rounds = static_cast<double>(rounds) / static_cast<double>(totals.blocks);
  const double writing = cost.of(cells, totals.kept).seconds;
  const auto seconds_for = [&](double n) {
    return (pilot.seconds_per_trial * n + pilot.seconds_per_cell * cells) * share_of_rounds + writing;
  };
  const double seconds = seconds_for(totals.trials);
  fmt::print("  time     about {}{}, {} of it for writing, on {}{}\n", duration_text(seconds),
             study.stop ? fmt::format(", at most {}", duration_text(seconds_for(most_trials))) : "",
             duration_text(writing), results::count_text(at_once, "thread"),
             busy < threads ? fmt::format(", {} of them at work: there are no more blocks", busy) : "");
  if (seconds > most_sensible_s)
    fmt::print("  note     that is more than a year: take fewer trials, or let [stop] give each cell what it needs\n");
  if (study.audit > 0.0) {
    fmt::print("  audit    by Ceres: the first {} trials of each cell and {:g} of the others\n",
               studies::always_audited, study.audit);
  }
  print_storage(study, plan, totals, cost);
  if (!not_reckoned.empty()) fmt::print("  note     writing is not reckoned: {}\n", not_reckoned);
  return seconds;
}

void write_slurm(const PlanOptions& options, const studies::Study& study, core::Isa isa, double seconds) {
  const auto shares =
      options.shares.value_or(static_cast<std::uint64_t>(std::clamp(std::ceil(seconds / share_s), 2.0, most_shares)));
  const SlurmJob job{options.study.studies.front(),
                     study.name,
                     options.study.overrides,
                     std::string(core::name_of(isa)),
                     options.study.threads,
                     shares,
                     seconds / static_cast<double>(shares),
                     options.slurm};
  write_output(options.slurm, [&](std::ostream& out) { out << slurm_script(job); });
  fmt::print("  slurm    {} shares; sbatch {}, and when all are there: {}\n", shares,
             results::shell_word(options.slurm), merge_command(job));
}

}  // namespace

int plan(const PlanOptions& options) {
  const core::Isa isa = instruction_set(options.study.isa);
  const bool slurm = !options.slurm.empty();
  if (slurm && options.study.studies.size() > 1)
    throw core::InputError("--slurm: a job script is for one study; plan them one at a time");
  for (const std::string& name : options.study.studies) {
    const studies::Study study = studies::read_study(studies::find_study(name), options.study.overrides);
    if (slurm) require_shareable(study);
    const double seconds = print_plan(study, isa, options.study.threads);
    if (slurm) write_slurm(options, study, isa, seconds);
  }
  return Success;
}

}  // namespace ridgeloc::app
