#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "app/continuation.hpp"
#include "app/duration.hpp"
#include "app/exit_code.hpp"
#include "app/instruction_set.hpp"
#include "app/output.hpp"
#include "app/slurm.hpp"
#include "app/stop_text.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "results/schema/text.hpp"
#include "results/util/shell.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "studies/run/pilot.hpp"
#include "studies/study/audit_sample.hpp"

namespace ridgeloc::app {

namespace {

constexpr double pilot_budget_s = 2.0;

constexpr double share_s = 3600.0;
constexpr double most_shares = 1000.0;  // Slurm's arrays end there unless its configuration says otherwise

/// "0.71 us", "15 ms", "2 s".
std::string trial_time_text(double seconds) {
  if (seconds < 1e-3) return fmt::format("{:.3g} us", seconds * 1e6);
  return seconds < 1.0 ? fmt::format("{:.3g} ms", seconds * 1e3) : fmt::format("{:.3g} s", seconds);
}

/// Prints it and returns the seconds that the study is expected to take.
double print_plan(const studies::Study& study, core::Isa isa, int threads) {
  const studies::Plan plan = studies::make_plan(study, isa);
  const auto cells = static_cast<double>(plan.cells.size());
  const studies::Pilot pilot = studies::run_pilot(study, plan, pilot_budget_s);
  std::vector<std::uint64_t> cell_trials = pilot.predicted_trials;
  if (cell_trials.empty()) cell_trials.assign(plan.cells.size(), study.trials);
  const std::uint64_t block = plan.header.block_trials;
  double trials = 0.0;
  double kept = 0.0;
  std::uint64_t blocks = 0;
  for (const std::uint64_t n : cell_trials) {
    trials += static_cast<double>(n);
    kept += static_cast<double>(std::min(n, plan.header.trial_column_blocks * block));
    blocks += (n + block - 1) / block;
  }
  const double columns_mib = kept * static_cast<double>(studies::bytes_per_trial(study)) / core::mebibyte;
  const auto [least, most] = std::ranges::minmax(cell_trials);
  const double most_trials = study.stop ? static_cast<double>(study.stop->max_trials) * cells : trials;

  fmt::print("{}: {}\n", study.name, study.title);
  for (const auto& axis : plan.header.axes) fmt::print("  axis     {} ({} values)\n", axis.name, axis.values.size());
  for (const auto& method : study.methods) fmt::print("  method   {} ({})\n", method.label, method.solver);
  for (const std::string& remark : plan.remarks) fmt::print("  note     {}\n", remark);
  fmt::print("  cells    {}\n", plan.cells.size());
  const std::string per_cell = least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
  fmt::print("  trials   {}{:.0f} ({} per cell){}\n", study.stop ? "about " : "", trials, per_cell,
             study.stop ? fmt::format(", at most {:.0f}", most_trials) : "");
  if (study.stop) {
    const studies::StopRule& rule = *study.stop;
    fmt::print("  stop     {}, after {} to {} trials per cell\n", target_text(rule), rule.min_trials, rule.max_trials);
    if (rule.max_cost > 0.0) fmt::print("           or at a cost of {:g} of all cells together\n", rule.max_cost);
  }
  fmt::print("  blocks   {} of {} trials\n", blocks, block);
  fmt::print("  pilot    {} per trial and thread, all methods, with {} ({} trials)\n",
             trial_time_text(pilot.seconds_per_trial), plan.header.isa, pilot.trials);
  // A block is the work of one thread, and they are computed in rounds of so many as there are threads.
  const auto busy = static_cast<int>(std::min(static_cast<std::uint64_t>(threads), blocks));
  const auto at_once = static_cast<std::uint64_t>(threads);
  const std::uint64_t rounds = (blocks + at_once - 1) / at_once;
  const double share_of_rounds = static_cast<double>(rounds) / static_cast<double>(blocks);
  const auto seconds_for = [&](double n) {
    return (pilot.seconds_per_trial * n + pilot.seconds_per_cell * cells) * share_of_rounds;
  };
  const double seconds = seconds_for(trials);
  fmt::print("  time     about {}{} on {}{}\n", duration_text(seconds),
             study.stop ? fmt::format(", at most {},", duration_text(seconds_for(most_trials))) : "",
             results::count_text(at_once, "thread"),
             busy < threads ? fmt::format(", {} of them at work: there are no more blocks", busy) : "");
  if (study.audit > 0.0) {
    fmt::print("  audit    by Ceres: the first {} trials of each cell and {:g} of the others\n",
               studies::always_audited, study.audit);
  }
  fmt::print("  disk     at most {:.1f} MiB of per-trial columns ({:.0f} trials kept) besides the summaries\n",
             columns_mib, kept);
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
