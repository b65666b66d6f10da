#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "app/duration.hpp"
#include "app/exit_code.hpp"
#include "app/instruction_set.hpp"
#include "app/verbs.hpp"
#include "core/units.hpp"
#include "studies/audit.hpp"
#include "studies/pilot.hpp"
#include "studies/study_reader.hpp"

namespace ridgeloc::app {

namespace {

constexpr double pilot_budget_s = 2.0;

void print_plan(const studies::Study& study, core::Isa isa, int threads) {
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

  fmt::print("{}: {}\n", study.name, study.title);
  for (const auto& axis : plan.header.axes) fmt::print("  axis     {} ({} values)\n", axis.name, axis.values.size());
  for (const auto& method : study.methods) fmt::print("  method   {} ({})\n", method.label, method.solver);
  fmt::print("  cells    {}\n", plan.cells.size());
  const std::string per_cell = least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
  fmt::print("  trials   {}{:.0f} ({} per cell)\n", study.stop ? "about " : "", trials, per_cell);
  if (study.stop) {
    const studies::StopRule& rule = *study.stop;
    fmt::print("  stop     when the standard error of the {} of {} is below {:g}{}, after {} to {} trials per cell\n",
               rule.statistic, rule.metric, rule.is_relative ? 100.0 * rule.target : rule.target,
               rule.is_relative ? " %" : "", rule.min_trials, rule.max_trials);
    if (rule.max_cost > 0.0) fmt::print("           or at a cost of {:g} of all cells together\n", rule.max_cost);
  }
  fmt::print("  blocks   {} of {} trials\n", blocks, block);
  fmt::print("  pilot    {:.3g} us per trial and thread, all methods, with {} ({} trials)\n",
             pilot.seconds_per_trial * 1e6, plan.header.isa, pilot.trials);
  const double seconds = pilot.seconds_per_trial * trials + pilot.seconds_per_cell * cells;
  fmt::print("  time     about {} on {} thread{}\n", duration_text(seconds / threads), threads,
             threads == 1 ? "" : "s");
  if (study.audit > 0.0) {
    fmt::print("  audit    by Ceres: the first {} trials of each cell and {:g} of the others\n",
               studies::always_audited, study.audit);
  }
  fmt::print("  disk     at most {:.1f} MiB of per-trial columns ({:.0f} trials kept) besides the summaries\n",
             columns_mib, kept);
}

}  // namespace

int plan(const StudyOptions& options) {
  const core::Isa isa = instruction_set(options.isa);
  for (const std::string& name : options.studies) {
    print_plan(studies::read_study(studies::find_study(name), options.overrides), isa, options.threads);
  }
  return Success;
}

}  // namespace ridgeloc::app
