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
#include "core/stream.hpp"
#include "results/schema.hpp"
#include "solvers/ceres_reference.hpp"
#include "solvers/options.hpp"
#include "studies/experiment.hpp"

namespace ridgeloc::studies {

/// Trials below this number are audited whatever the share, unless that is 0.
inline constexpr std::uint64_t always_audited = 100;

/// Which trials of every cell are solved again by the reference: trial t if t < `always_audited` or u(t) < share, where
/// u(t) is uniform on (0, 1), drawn from the seed on the grid (k + 1/2) 2^-32. A share of 0 audits nothing.
class AuditSample {
 public:
  explicit AuditSample(const StudyKey& key) : share_(key.audit), stream_(key.seed, "audit") {}

  /// Those among the trials of a block, counted from its first.
  std::vector<std::size_t> slots(TrialRange range) const;

 private:
  double share_;
  core::Stream stream_;
};

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
  using Columns = std::array<std::vector<double>, audit_metric_count>;
  void fill(std::string_view solver, const solvers::SolverOptions& options, const core::SolutionBatch& solutions,
            Columns& columns);

  const std::vector<std::size_t>& slots() const { return slots_; }

  /// Where the reference ends from the start of a trial, and from the truth.
  struct Answers {
    solvers::Minimizer from_start;
    solvers::Minimizer from_truth;
  };
  Answers solve(std::size_t slot, const solvers::ReferenceObjective& objective) const;

 private:
  using AnswersOfSlots = std::vector<Answers>;  ///< in the order of slots_

  const AnswersOfSlots& shared_answers(const solvers::ReferenceObjective& objective);
  std::array<double, audit_metric_count> judge(std::size_t slot, const solvers::ReferenceObjective& objective,
                                               const Answers& answers, const core::SolutionBatch& solutions) const;

  const core::ProblemBatch& problems_;
  const core::Oracle& oracle_;
  std::vector<std::size_t> slots_;
  std::vector<std::pair<solvers::ReferenceObjective, AnswersOfSlots>> shared_;
};

}  // namespace ridgeloc::studies
