#include "studies/solving/audit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/status.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::studies {

namespace {

constexpr double not_in_population = std::numeric_limits<double>::quiet_NaN();

/// Minimisers nearer to each other than this are taken for one. Both are known to rounding, so that a nearly flat
/// valley alone leaves a gap as large, and different ones are metres apart.
constexpr double same_place_m = 0.01;

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

bool same_place(const solvers::Minimizer& a, const solvers::Minimizer& b) {
  return distance(a.estimate, b.estimate) < same_place_m;
}

}  // namespace

std::vector<results::MetricInfo> audit_metrics() {
  std::vector<results::MetricInfo> metrics = {
      {"ref_gap_m", "m", "distance of converged trials from Ceres' minimiser from the same start", true},
      {"ref_objective_gap", "1", "objective of converged trials above Ceres' minimum, relative to the larger of them",
       true},
      {"ref_converged", "1", "audited trials in which Ceres finds a minimum from the same start"},
      {"ref_same_basin", "1", "converged trials from which Ceres goes to the minimum that it finds from the start"},
      {"ref_truth_basin", "1",
       "audited trials in which Ceres finds the same minimum from the start and from the truth"},
      {"ref_disagrees", "1", "converged trials whose remaining step is not the one that Ceres' gradient gives"},
  };
  for (std::size_t i = RefConverged; i < audit_metric_count; ++i) metrics[i].yes_no = true;
  metrics[RefDisagrees].alarm = "audited by Ceres";
  return metrics;
}

Audit::Audit(const core::ProblemBatch& problems, const core::Oracle& oracle, std::vector<std::size_t> slots)
    : problems_(problems), oracle_(oracle), slots_(std::move(slots)) {}

bool Audit::covers(std::string_view solver, const solvers::SolverOptions& options) {
  return solvers::reference_objective(solvers::solver_named(solver), options).has_value();
}

bool Audit::fill(std::string_view solver, const solvers::SolverOptions& options, const core::SolutionBatch& solutions,
                 const Monitor& monitor, Columns& columns) {
  for (std::vector<double>& column : columns) column.assign(slots_.size(), not_in_population);
  if (slots_.empty()) return true;
  const auto objective = *solvers::reference_objective(solvers::solver_named(solver), options);
  const bool of_estimate = objective.loss == solvers::ReferenceLoss::Reweighted;
  const AnswersOfSlots* shared = of_estimate ? nullptr : shared_answers(objective, monitor);
  if (!of_estimate && shared == nullptr) return false;
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    if (monitor.stop_requested()) return false;
    const std::size_t slot = slots_[i];
    std::array<double, audit_metric_count> values{};
    if (of_estimate) {
      // Where the solver has failed there is no scale to take the objective at.
      if (solutions.status[slot] != static_cast<std::uint8_t>(core::Status::Converged)) continue;
      const std::array<double, 3> estimate{solutions.estimate[0][slot], solutions.estimate[1][slot],
                                           solutions.estimate[2][slot]};
      const auto own = solvers::at_estimate(objective, problems_, slot, {estimate, solutions.image_distance_mm[slot]});
      values = judge(slot, own, solve(slot, own), solutions);
    } else {
      values = judge(slot, objective, (*shared)[i], solutions);
    }
    for (std::size_t m = 0; m < audit_metric_count; ++m) columns[m][i] = values[m];
  }
  return true;
}

Audit::Answers Audit::solve(std::size_t slot, const solvers::ReferenceObjective& objective) const {
  const std::array<double, 3> start{problems_.start(0)[slot], problems_.start(1)[slot], problems_.start(2)[slot]};
  solvers::ReferencePlace truth({oracle_.truth[0][slot], oracle_.truth[1][slot], oracle_.truth[2][slot]});
  if (!oracle_.image_distance.empty()) truth.image_distance_mm = oracle_.image_distance[slot];
  return {solvers::minimize(problems_, slot, start, objective), solvers::minimize(problems_, slot, truth, objective)};
}

const Audit::AnswersOfSlots* Audit::shared_answers(const solvers::ReferenceObjective& objective,
                                                   const Monitor& monitor) {
  const auto known = std::ranges::find_if(shared_, [&](const auto& entry) { return entry.first == objective; });
  if (known != shared_.end()) return &known->second;
  AnswersOfSlots answers;
  for (const std::size_t slot : slots_) {
    if (monitor.stop_requested()) return nullptr;
    answers.push_back(solve(slot, objective));
  }
  return &shared_.emplace_back(objective, std::move(answers)).second;
}

std::array<double, audit_metric_count> Audit::judge(std::size_t slot, const solvers::ReferenceObjective& objective,
                                                    const Answers& answers,
                                                    const core::SolutionBatch& solutions) const {
  std::array<double, audit_metric_count> values{};
  values.fill(not_in_population);
  const auto yes = [](bool holds) { return holds ? 1.0 : 0.0; };
  values[RefConverged] = yes(answers.from_start.converged);
  if (answers.from_start.converged && answers.from_truth.converged) {
    values[RefTruthBasin] = yes(same_place(answers.from_start, answers.from_truth));
  }
  if (solutions.status[slot] != static_cast<std::uint8_t>(core::Status::Converged)) return values;

  const solvers::ReferencePlace ours(
      {solutions.estimate[0][slot], solutions.estimate[1][slot], solutions.estimate[2][slot]},
      solutions.image_distance_mm[slot]);
  const solvers::ReferenceStep step = solvers::undamped_step(problems_, slot, ours, objective);
  if (objective.binding && !std::isnan(step.step_m)) {
    values[RefDisagrees] = yes(!(std::fabs(step.step_m - solutions.remaining_step_m[slot]) <= step.step_error_m));
  }
  if (!answers.from_start.converged) return values;
  const double gap = distance(ours.position, answers.from_start.estimate);
  values[RefGapM] = gap;
  // Below its rounding error an objective is as good as zero.
  const double scale = std::max({step.cost, answers.from_start.cost, step.cost_error});
  values[RefObjectiveGap] = (step.cost - answers.from_start.cost) / scale;
  values[RefSameBasin] = 1.0;
  if (!(gap < same_place_m)) {
    const solvers::Minimizer from_ours = solvers::minimize(problems_, slot, ours, objective);
    values[RefSameBasin] = from_ours.converged ? yes(same_place(from_ours, answers.from_start)) : not_in_population;
  }
  return values;
}

}  // namespace ridgeloc::studies
