#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "core/problem.hpp"
#include "core/solution.hpp"
#include "results/schema/schema.hpp"
#include "solvers/options.hpp"
#include "solvers/reference/ceres_reference.hpp"
#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// What the audit says of a trial, in the order of its metrics. docs/studies.md defines them.
enum AuditMetric : std::size_t {
  RefGapM,
  RefObjectiveGap,
  RefConverged,
  RefSameBasin,
  RefTruthBasin,
  RefDisagrees,
  audit_metric_count
};
std::vector<results::MetricInfo> audit_metrics();

/// Solves some trials of a batch again with the reference. Methods with the same objective share its answers.
class Audit {
 public:
  /// `slots`: the trials to solve again. The reference is started at the truth of the oracle, and at the true image
  /// distance where there is one. Problems and oracle must live as long.
  Audit(const core::ProblemBatch& problems, const core::Oracle& oracle, std::vector<std::size_t> slots);

  /// Whether the solver has an objective that the reference can minimise.
  static bool covers(std::string_view solver, const solvers::SolverOptions& options);

  /// The metrics of one method, a column each with a value per slot; NaN where the trial is not in the metric's
  /// population. Precondition: covers(solver, options).
  ///
  /// Asks the monitor before each trial; returns false, and then the columns are of no use, if that asked to stop.
  using Columns = std::array<std::vector<double>, audit_metric_count>;
  [[nodiscard]] bool fill(std::string_view solver, const solvers::SolverOptions& options,
                          const core::SolutionBatch& solutions, const Monitor& monitor, Columns& columns);

  const std::vector<std::size_t>& slots() const { return slots_; }

  /// Where the reference ends from the start of a trial, and from the truth.
  struct Answers {
    solvers::Minimizer from_start;
    solvers::Minimizer from_truth;
  };
  Answers solve(std::size_t slot, const solvers::ReferenceObjective& objective) const;

 private:
  using AnswersOfSlots = std::vector<Answers>;  ///< in the order of slots_

  /// Null if the monitor asked to stop.
  const AnswersOfSlots* shared_answers(const solvers::ReferenceObjective& objective, const Monitor& monitor);
  std::array<double, audit_metric_count> judge(std::size_t slot, const solvers::ReferenceObjective& objective,
                                               const Answers& answers, const core::SolutionBatch& solutions) const;

  const core::ProblemBatch& problems_;
  const core::Oracle& oracle_;
  std::vector<std::size_t> slots_;
  std::vector<std::pair<solvers::ReferenceObjective, AnswersOfSlots>> shared_;
};

}  // namespace ridgeloc::studies
