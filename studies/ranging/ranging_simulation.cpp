#include "studies/ranging/ranging_simulation.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "core/problem.hpp"
#include "core/solution.hpp"
#include "solvers/solver.hpp"
#include "studies/ranging/nees.hpp"
#include "studies/ranging/ranging_replay.hpp"
#include "studies/ranging/ranging_schema.hpp"
#include "studies/ranging/ranging_trials.hpp"
#include "studies/solving/audit.hpp"
#include "studies/solving/pieces.hpp"
#include "studies/solving/solver_settings.hpp"
#include "studies/study/audit_sample.hpp"
#include "studies/study/capabilities.hpp"

namespace ridgeloc::studies {

namespace {

using namespace ranging;

/// A method with what a block would otherwise find out anew.
struct PreparedMethod {
  PreparedMethod(const Method& given, const RangingCell& settings, const Values& cell, double audit)
      : method(given),
        options(solver_options(cell, given.given)),
        entry(solvers::solver_named(given.solver)),
        is_audited(audit > 0.0 && Audit::covers(given.solver, options)) {
    const bool is_printed = options.jacobian == solvers::Jacobian::Printed;
    has_nees = has_plain_noise(settings) && !settings.has_images && !settings.knows_height && !is_printed &&
               entry.is_least_squares;
  }

  Method method;
  solvers::SolverOptions options;
  const solvers::SolverEntry& entry;
  bool is_audited;
  bool has_nees = false;
};

class RangingSimulation : public Simulation, public FailureRecount, public TrialReplay {
 public:
  RangingSimulation(const StudyKey& key, const Cell& cell, std::span<const Method> methods)
      : key_(key), cell_(cell), settings_(cell.values), scene_options_(solver_options(cell.values, {})) {
    for (const Method& method : methods) methods_.emplace_back(method, settings_, cell.values, key.audit);
  }

  bool run_block(TrialRange range, Workspace& workspace, Monitor& monitor, results::BlockSink& sink) const override {
    auto& scratch = own<RangingScratch>(workspace);
    const core::Oracle oracle = simulate_ranging(key_.seed, settings_, range, scratch);
    Audit audit(scratch.problems, oracle, AuditSample(key_).slots(range));
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const PreparedMethod& method = methods_[m];
      if (!solve(method, oracle, scratch, monitor)) return false;
      report_method(m, method.options, method.entry.has_k, oracle, scratch, sink);
      if (method.has_nees) report_nees(m, settings_, oracle, scratch, sink);
      if (!method.is_audited) continue;
      if (!audit.fill(method.method.solver, method.options, scratch.solutions, monitor, scratch.audit)) return false;
      for (std::size_t i = 0; i < audit_metric_count; ++i)
        sink.sparse_metric(m, FirstOfAudit + i, audit.slots(), scratch.audit[i]);
    }
    report_scene(methods_.size(), settings_, scene_options_, oracle, scratch, sink);
    return true;
  }

  std::vector<FailureCounts> count_failures(TrialRange range, Workspace& workspace) const override {
    auto& scratch = own<RangingScratch>(workspace);
    const core::Oracle oracle = simulate_ranging(key_.seed, settings_, range, scratch);
    const Audit audit(scratch.problems, oracle, {});
    std::vector<FailureCounts> counts;
    for (const PreparedMethod& method : methods_) {
      method.entry.kernel(scratch.isa)(scratch.problems, method.options, &oracle, scratch.solutions);
      const auto objective = solvers::reference_objective(method.entry, method.options);
      FailureCounts& count = counts.emplace_back();
      // The objective of irls is that of its last weights, and a failed trial has none that mean anything.
      count.has_reference = objective && objective->loss != solvers::ReferenceLoss::Reweighted;
      count.trials = range.count;
      for (std::size_t t = 0; t < range.count; ++t) {
        if (scratch.solutions.status[t] == static_cast<std::uint8_t>(core::Status::Converged)) continue;
        ++count.failed;
        if (!count.has_reference) continue;
        const Audit::Answers answers = audit.solve(t, *objective);
        count.from_start += answers.from_start.converged ? 1 : 0;
        count.from_truth += answers.from_truth.converged ? 1 : 0;
      }
    }
    return counts;
  }

  Replay replay(std::uint64_t trial, Workspace& workspace) const override {
    std::vector<Method> methods;
    for (const PreparedMethod& method : methods_) methods.push_back(method.method);
    return replay_ranging(key_.seed, cell_, methods, trial, own<RangingScratch>(workspace));
  }

 private:
  static bool solve(const PreparedMethod& method, const core::Oracle& oracle, RangingScratch& scratch,
                    const Monitor& monitor) {
    return solve_in_pieces(method.entry.kernel(scratch.isa), scratch.problems, method.options, oracle,
                           scratch.solutions, scratch.piece, monitor);
  }

  static void report_nees(std::size_t m, const RangingCell& settings, const core::Oracle& oracle,
                          RangingScratch& scratch, results::BlockSink& sink) {
    const core::SolutionBatch& s = scratch.solutions;
    scratch.values.resize(s.trials());
    normalized_squared_errors(scratch.problems, {s.estimate[0], s.estimate[1], s.estimate[2]}, oracle.truth,
                              settings.range_sigma_m, scratch.values);
    for (std::size_t t = 0; t < s.trials(); ++t)
      if (s.status[t] != static_cast<std::uint8_t>(core::Status::Converged))
        scratch.values[t] = std::numeric_limits<double>::quiet_NaN();
    sink.metric(m, Nees, scratch.values);
  }

  /// Writes f(trial) for every trial into one column of the sink.
  template <class F>
  static void report(std::size_t method, Metric metric, RangingScratch& scratch, results::BlockSink& sink, F&& value) {
    scratch.values.resize(scratch.problems.trials());
    for (std::size_t t = 0; t < scratch.values.size(); ++t) scratch.values[t] = value(t);
    sink.metric(method, metric, scratch.values);
  }

  static void report_method(std::size_t m, const solvers::SolverOptions& options, bool has_k,
                            const core::Oracle& oracle, RangingScratch& scratch, results::BlockSink& sink) {
    const core::SolutionBatch& s = scratch.solutions;
    constexpr double not_in_population = std::numeric_limits<double>::quiet_NaN();
    const auto converged = [&](std::size_t t) {
      return s.status[t] == static_cast<std::uint8_t>(core::Status::Converged);
    };
    const auto error = [&](std::size_t t) {
      double squared = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = s.estimate[axis][t] - oracle.truth[axis][t];
        squared += d * d;
      }
      return std::sqrt(squared);
    };

    sink.status(m, s.status);
    scratch.flags.resize(s.trials());
    for (std::size_t t = 0; t < s.trials(); ++t) {
      scratch.flags[t] = converged(t) && s.remaining_step_m[t] < options.step_tolerance_m ? 1 : 0;
    }
    sink.event(m, core::status_names.size(), scratch.flags);

    report(m, ErrorM, scratch, sink, [&](std::size_t t) { return converged(t) ? error(t) : not_in_population; });
    report(m, ErrorAllM, scratch, sink, [&](std::size_t t) {
      const double e = error(t);
      return std::isfinite(e) ? e : std::numeric_limits<double>::infinity();
    });
    report(m, SquaredErrorM2, scratch, sink, [&](std::size_t t) {
      const double e = error(t);
      return std::isfinite(e) ? e * e : std::numeric_limits<double>::infinity();
    });
    report(m, ErrorXM, scratch, sink, [&](std::size_t t) {
      const double e = s.estimate[0][t] - oracle.truth[0][t];
      return std::isfinite(e) ? e : std::numeric_limits<double>::infinity();
    });
    report(m, Iterations, scratch, sink,
           [&](std::size_t t) { return converged(t) ? s.iterations[t] : static_cast<double>(options.max_iterations); });
    if (has_k) {
      sink.metric(m, EtaFirst, s.eta_first);
      sink.metric(m, EtaLast, s.eta_last);
      sink.metric(m, EtaMean, s.eta_mean);
    }
    report(m, ResidualRmsM, scratch, sink,
           [&](std::size_t t) { return converged(t) ? s.residual_rms_m[t] : not_in_population; });
  }

  static void report_scene(std::size_t label, const RangingCell& settings, const solvers::SolverOptions& options,
                           const core::Oracle& oracle, RangingScratch& scratch, results::BlockSink& sink) {
    scratch.values.resize(scratch.problems.trials());
    scratch.condition.resize(scratch.problems.trials());
    solvers::geometry_kernel(scratch.isa)(scratch.problems, options, oracle, scratch.values, scratch.condition);
    sink.metric(label, Gdop, scratch.values);
    sink.metric(label, ranging::Condition, scratch.condition);
    for (double& value : scratch.values) value = std::isinf(value) ? value : value * settings.range_sigma_m;
    sink.metric(label, CrbM, scratch.values);
  }

  StudyKey key_;
  Cell cell_;
  RangingCell settings_;
  solvers::SolverOptions scene_options_;
  std::vector<PreparedMethod> methods_;
};

}  // namespace

std::unique_ptr<const Simulation> ranging_simulation(const StudyKey& key, const Cell& cell,
                                                     std::span<const Method> methods) {
  return std::make_unique<RangingSimulation>(key, cell, methods);
}

bool has_plain_noise(const RangingCell& settings) {
  return settings.noise->name == "normal" && !settings.has_scores;
}

}  // namespace ridgeloc::studies
