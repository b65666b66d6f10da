#include "studies/ranging/ranging.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/problem.hpp"
#include "core/solution.hpp"
#include "sim/field_of_view.hpp"
#include "solvers/solver.hpp"
#include "studies/ranging/nees.hpp"
#include "studies/ranging/ranging_replay.hpp"
#include "studies/ranging/ranging_settings.hpp"
#include "studies/ranging/ranging_trials.hpp"
#include "studies/solving/audit.hpp"
#include "studies/solving/solver_settings.hpp"
#include "studies/study/audit_sample.hpp"

namespace ridgeloc::studies {

namespace {

constexpr std::string_view scene_label = "scene";

// Columns of the schema, in its order.
enum Metric : std::size_t {
  ErrorM,
  ErrorAllM,
  Iterations,
  EtaFirst,
  EtaLast,
  EtaMean,
  ResidualRmsM,
  CrbM,
  Gdop,
  Condition,
  SquaredErrorM2,
  ErrorXM,
  FirstOfAudit,  ///< and the others, in the order of AuditMetric
  Nees = FirstOfAudit + audit_metric_count
};

results::Schema make_schema() {
  results::Schema schema;
  schema.metrics = {
      {"error_m", "m", "position error of converged trials", false},
      {"error_all_m", "m", "position error of all trials", true},
      {"iterations", "1", "iterations, a failed trial counting the limit", false, true},
      {"eta_first", "1", "similarity of K to the true K at the first iteration", false},
      {"eta_last", "1", "similarity of K to the true K at the last iteration", false},
      {"eta_mean", "1", "similarity of K to the true K averaged over the iterations", false},
      {"residual_rms_m", "m", "root mean square residual of converged trials", false},
      {"crb_m", "m", "Cramer-Rao bound of unbiased position estimates", true},
      {"gdop", "1", "geometric dilution of precision", true},
      {"condition", "1", "condition number of J'J at the truth", true},
      {"squared_error_m2", "m2", "squared position error of all trials", true},
      {"error_x_m", "m", "signed position error of all trials along the optical axis", true},
  };
  for (const Metric compared : {ErrorM, ErrorAllM, SquaredErrorM2, Iterations})
    schema.metrics[compared].is_compared = true;
  for (const Metric bounded : {ErrorM, ErrorAllM}) schema.metrics[bounded].bound = schema.metrics[CrbM].name;
  for (results::MetricInfo& metric : studies::audit_metrics()) schema.metrics.push_back(std::move(metric));
  schema.metrics.push_back({"nees", "1", "normalized squared position error of converged trials", false});
  schema.metrics[Nees].chi_square = core::position_parameters;
  for (const std::string_view status : core::status_names) {
    const bool is_failure = status != core::status_names[static_cast<std::size_t>(core::Status::Converged)];
    schema.events.push_back({std::string(status), "trials that ended as " + std::string(status), is_failure});
  }
  schema.statuses = schema.events.size();
  // A small |J'We| alone would not tell a solver that has arrived from one that is held back where J'WJ is small; the
  // step that it leads to without K or damping does.
  schema.events.push_back(
      {"stationary", "converged trials whose next step without K or damping is shorter than the step tolerance"});
  return schema;
}

class Ranging : public Experiment {
 public:
  std::string_view name() const override { return "ranging"; }
  std::string_view summary() const override {
    return "noisy ranges to objects in a field of view (RRR paper, section 4, Fig. 3)";
  }
  int version() const override { return 4; }
  std::uint64_t block_trials() const override { return 4096; }
  std::span<const Setting> settings() const override { return ranging_settings(); }
  const results::Schema& schema() const override {
    static const results::Schema schema = make_schema();
    return schema;
  }

  void check(const Values& cell) const override {
    const RangingCell settings(cell);
    const auto before_camera = [](const std::array<double, 2>& interval) {
      return interval[0] > -90.0 && interval[1] < 90.0;
    };
    if (settings.has_images &&
        !(before_camera(settings.view.azimuth_deg) && before_camera(settings.view.elevation_deg))) {
      throw core::InputError(
          "scene.model = \"pseudorange\" needs points before the camera: "
          "scene.azimuth_deg and scene.elevation_deg within -90 to 90, ends excluded");
    }
  }

  /// The bound is that of normal noise of one level. Over random scenes the mean of its square is finite from two
  /// observations more than unknowns on.
  results::BoundKind bound(const Values& cell) const override {
    const RangingCell settings(cell);
    if (!has_plain_noise(settings)) return results::BoundKind::None;
    const solvers::SolverOptions options = solver_options(cell, {});
    const bool knows_height = settings.has_images && options.z_mode == solvers::ZMode::Fixed;
    const bool seeks_distance = settings.has_images && options.v_mode != solvers::VMode::Fixed;
    const bool has_prior = settings.has_images && options.v_mode == solvers::VMode::Prior;
    const std::size_t unknowns = core::position_parameters - (knows_height ? 1 : 0) + (seeks_distance ? 1 : 0);
    const std::size_t observations = settings.points + (has_prior ? 1 : 0);
    return observations >= unknowns + 2 ? results::BoundKind::RootMeanSquare : results::BoundKind::Quantiles;
  }

  /// Iterations times observations.
  double cost(const Values& cell, const results::Statistics& statistics) const override {
    if (statistics.metrics.empty()) return 0.0;
    const results::Moments& iterations = statistics.metrics[Iterations].moments;
    return iterations.mean * static_cast<double>(iterations.n) *
           static_cast<double>(std::get<std::int64_t>(cell.at("points")));
  }

  std::size_t audit_metrics() const override { return audit_metric_count; }

  std::string_view example() const override {
    return R"([sweep]
points = [3, 5, 7]
range_sigma_m = [0.1, 0.3, 0.5]

[[method]]
solver = "ols"

[[method]]
solver = "rr"

[[method]]
solver = "rrr"

[[figure]]
x = "points"
y = "error_m"
statistic = "median"
group = "range_sigma_m"
facet = "method"
methods = ["ols", "rr", "rrr"]
)";
  }

  std::vector<std::string> solvers() const override { return solver_names(); }

  std::vector<std::string> settings_of_solver(std::string_view solver) const override {
    return solver == scene_label ? std::vector<std::string>{"v_mode"} : settings_read_by(solver);
  }

  std::vector<std::string> extra_labels() const override { return {std::string(scene_label)}; }

  std::unique_ptr<Workspace> make_workspace(core::Isa isa) const override {
    return std::make_unique<RangingScratch>(isa);
  }

  void run_block(const StudyKey& key, const Cell& cell, std::span<const Method> methods, TrialRange range,
                 Workspace& workspace, results::BlockSink& sink) const override {
    auto& scratch = static_cast<RangingScratch&>(workspace);
    const RangingCell settings(cell.values);
    const core::Oracle oracle = simulate_ranging(key.seed, settings, range, scratch);
    Audit audit(scratch.problems, oracle, AuditSample(key).slots(range));
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const solvers::SolverOptions options = solver_options(cell.values, methods[m].given);
      const solvers::Solver solve = solvers::find_solver(methods[m].solver)->kernel(scratch.isa);
      solve(scratch.problems, options, &oracle, scratch.solutions);
      const auto read = settings_of_solver(methods[m].solver);
      const bool reads_k = std::ranges::find(read, "k") != read.end();
      report_method(m, options, reads_k, scratch, sink);
      const bool is_printed = options.jacobian == solvers::Jacobian::Printed;
      if (has_plain_noise(settings) && !settings.has_images && !is_printed && is_least_squares(methods[m].solver))
        report_nees(m, settings, scratch, sink);
      if (key.audit > 0.0 && Audit::covers(methods[m].solver, options)) {
        audit.fill(methods[m].solver, options, scratch.solutions, scratch.audit);
        for (std::size_t i = 0; i < audit_metric_count; ++i)
          sink.sparse_metric(m, FirstOfAudit + i, audit.slots(), scratch.audit[i]);
      }
    }
    report_scene(methods.size(), settings, solver_options(cell.values, {}), oracle, scratch, sink);
  }

  std::vector<FailureCounts> count_failures(std::uint64_t seed, const Cell& cell, std::span<const Method> methods,
                                            TrialRange range, Workspace& workspace) const override {
    auto& scratch = static_cast<RangingScratch&>(workspace);
    const RangingCell settings(cell.values);
    const core::Oracle oracle = simulate_ranging(seed, settings, range, scratch);
    const Audit audit(scratch.problems, oracle, {});
    std::vector<FailureCounts> counts;
    for (const Method& method : methods) {
      const solvers::SolverOptions options = solver_options(cell.values, method.given);
      solvers::find_solver(method.solver)->kernel(scratch.isa)(scratch.problems, options, &oracle, scratch.solutions);
      const auto objective = solvers::reference_objective(method.solver, options);
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

  Replay replay(std::uint64_t seed, const Cell& cell, std::span<const Method> methods, std::uint64_t trial,
                Workspace& workspace) const override {
    return replay_ranging(seed, cell, methods, trial, static_cast<RangingScratch&>(workspace));
  }

 private:
  /// Normal and of one level, as the bound and the covariance of least squares have it.
  static bool has_plain_noise(const RangingCell& settings) {
    return settings.noise->name == "normal" && !settings.has_scores;
  }

  /// Solvers whose estimates are the least-squares minimum, but for where they stop.
  static bool is_least_squares(std::string_view solver) {
    return solver == "ols" || solver == "lm" || solver == "dogleg";
  }

  static void report_nees(std::size_t m, const RangingCell& settings, RangingScratch& scratch,
                          results::BlockSink& sink) {
    const core::SolutionBatch& s = scratch.solutions;
    scratch.values.resize(s.trials());
    normalized_squared_errors(scratch.problems, {s.estimate[0], s.estimate[1], s.estimate[2]}, sim::true_position_m,
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

  static void report_method(std::size_t m, const solvers::SolverOptions& options, bool reads_k, RangingScratch& scratch,
                            results::BlockSink& sink) {
    const core::SolutionBatch& s = scratch.solutions;
    constexpr double not_in_population = std::numeric_limits<double>::quiet_NaN();
    const auto converged = [&](std::size_t t) {
      return s.status[t] == static_cast<std::uint8_t>(core::Status::Converged);
    };
    const auto error = [&](std::size_t t) {
      double squared = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = s.estimate[axis][t] - sim::true_position_m[axis];
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
      const double e = s.estimate[0][t] - sim::true_position_m[0];
      return std::isfinite(e) ? e : std::numeric_limits<double>::infinity();
    });
    report(m, Iterations, scratch, sink,
           [&](std::size_t t) { return converged(t) ? s.iterations[t] : static_cast<double>(options.max_iterations); });
    if (reads_k) {
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
    sink.metric(label, Condition, scratch.condition);
    for (double& value : scratch.values) value = std::isinf(value) ? value : value * settings.range_sigma_m;
    sink.metric(label, CrbM, scratch.values);
  }
};

}  // namespace

const Experiment& ranging_experiment() {
  static const Ranging experiment;
  return experiment;
}

}  // namespace ridgeloc::studies
