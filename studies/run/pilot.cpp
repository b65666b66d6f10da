#include "studies/run/pilot.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <utility>

#include "core/elapsed.hpp"
#include "studies/run/workbench.hpp"
#include "studies/study/audit_sample.hpp"

namespace ridgeloc::studies {

namespace {

std::uint64_t predicted(const Study& study, const Plan& plan, std::uint64_t trials, results::BlockSink& sink) {
  std::vector<results::Statistics> statistics(plan.header.methods.size());
  for (results::Row& row : sink.take_rows()) statistics[row.method] = std::move(row.statistics);
  const Precision precision = precision_of(*study.stop, plan.header, statistics);
  return predicted_trials(*study.stop, precision, trials, plan.header.block_trials);
}

/// Cells in an order in which the first few are spread over all: bit-reversed numbers.
std::vector<std::size_t> spread_order(std::size_t cells) {
  const int bits = static_cast<int>(std::bit_width(cells));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < std::size_t{1} << bits; ++i) {
    std::size_t reversed = 0;
    for (int bit = 0; bit < bits; ++bit) reversed |= (i >> bit & 1U) << (bits - 1 - bit);
    if (reversed < cells) order.push_back(reversed);
  }
  return order;
}

using Clock = std::chrono::steady_clock;

/// Runs trials of cells and keeps nothing but what they say of the whole.
class PilotRun {
 public:
  PilotRun(const Study& study, const Plan& plan, double budget_s)
      : study_(study), plan_(plan), budget_s_(budget_s), bench_(study, plan, 1) {}

  Pilot run() {
    // A fourth more trials each time: the last round is the longest and so the least disturbed by what happens once.
    run_round(1);
    for (std::uint64_t count = 4; count <= plan_.header.block_trials && !is_over(); count *= 4) run_round(count);
    if (study_.audit > 0.0) run_audited();
    return std::move(pilot_);
  }

 private:
  bool is_over() const { return core::seconds_since(begin_) >= budget_s_; }

  void run_round(std::uint64_t count) {
    double seconds = 0.0;
    std::uint64_t trials = 0;
    std::vector<std::uint64_t> predictions(plan_.cells.size());
    for (const std::size_t cell : spread_order(plan_.cells.size())) {
      // A round that is not finished counts only if it is the first.
      if (trials > 0 && is_over() && count == 1) break;
      if (is_over() && count > 1) return;
      results::BlockSink sink(plan_.header, cell, 1, count);
      // Of the second block: the first trials of all are audited, which would cost more than the rest.
      seconds += seconds_for(cell, {plan_.header.block_trials, static_cast<std::size_t>(count)}, sink);
      trials += count;
      if (study_.stop) predictions[cell] = predicted(study_, plan_, count, sink);
    }
    pilot_.seconds_per_trial = seconds / static_cast<double>(trials);
    pilot_.trials += trials;
    if (study_.stop) {
      // What was not run is taken for the longest of those that were.
      const std::uint64_t most = *std::ranges::max_element(predictions);
      std::ranges::replace(predictions, std::uint64_t{0}, most);
      pilot_.predicted_trials = std::move(predictions);
    }
  }

  void run_audited() {
    const std::uint64_t audited = std::min(study_.trials, always_audited);
    // Of slow trials so many as take about the budget.
    const double affordable = std::clamp(budget_s_ / pilot_.seconds_per_trial, 1.0, static_cast<double>(audited));
    const std::uint64_t count = std::min(static_cast<std::uint64_t>(affordable), plan_.header.block_trials);
    results::BlockSink sink(plan_.header, 0, 0, count);
    const double seconds = seconds_for(0, {0, static_cast<std::size_t>(count)}, sink);
    const double more = seconds - pilot_.seconds_per_trial * static_cast<double>(count);
    pilot_.seconds_per_cell = std::max(more, 0.0) * static_cast<double>(audited) / static_cast<double>(count);
  }

  double seconds_for(std::size_t cell, TrialRange range, results::BlockSink& sink) {
    const Simulation& simulation = bench_.simulation(0, cell, study_.methods);
    Workspace& workspace = bench_.workspace(0);
    NoMonitor monitor;
    const Clock::time_point begin = Clock::now();
    static_cast<void>(simulation.run_block(range, workspace, monitor, sink));
    return core::seconds_since(begin);
  }

  const Study& study_;
  const Plan& plan_;
  double budget_s_;
  Workbench bench_;
  Clock::time_point begin_ = Clock::now();
  Pilot pilot_;
};

}  // namespace

Pilot run_pilot(const Study& study, const Plan& plan, double budget_s) {
  return PilotRun(study, plan, budget_s).run();
}

}  // namespace ridgeloc::studies
