#include "studies/ranging/ranging_replay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/status.hpp"
#include "solvers/kernels/trace.hpp"
#include "solvers/solver.hpp"
#include "studies/ranging/ranging_drawing.hpp"
#include "studies/solving/solver_settings.hpp"

namespace ridgeloc::studies {

namespace {

using results::DataTable;
using results::Field;

using Position = std::array<double, core::position_parameters>;

/// The trial of a batch of one in every lane of a kernel.
struct EveryLane {
  static constexpr std::size_t lanes = core::ProblemBatch::largest_lanes;
  core::ProblemBatch problems;
  std::array<std::vector<double>, core::position_parameters> truth;
  std::vector<double> image_distance;
  core::Oracle oracle;

  EveryLane(const core::ProblemBatch& one, const core::Oracle& known) : oracle(known) {
    problems.reshape(one.points(), lanes);
    if (one.has_scores()) problems.add_scores();
    if (one.has_images()) problems.add_images();
    for (std::size_t lane = 0; lane < lanes; ++lane) problems.copy_trial(one, 0, lane);
    for (std::size_t axis = 0; axis < truth.size(); ++axis) {
      truth[axis].assign(lanes, known.truth[axis][0]);
      oracle.truth[axis] = truth[axis];
    }
    if (known.image_distance.empty()) return;
    image_distance.assign(lanes, known.image_distance[0]);
    oracle.image_distance = image_distance;
  }
};

double distance(const Position& a, const Position& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Position estimate_of(const core::SolutionBatch& solutions) {
  return {solutions.estimate[0][0], solutions.estimate[1][0], solutions.estimate[2][0]};
}

/// A number that is there only sometimes.
Field if_number(double value) {
  return std::isnan(value) ? Field() : Field(value);
}

class TrialTables {
 public:
  TrialTables(const core::ProblemBatch& problems, const core::Oracle& oracle)
      : problems_(problems), truth_{oracle.truth[0][0], oracle.truth[1][0], oracle.truth[2][0]} {
    if (problems.has_images()) true_distance_ = oracle.image_distance[0];
  }

  std::vector<DataTable> scene() const {
    DataTable objects{
        "objects",
        {"object", "x_m", "y_m", "z_m", "true_range_m", "measured_range_m", "rho_m2", "alpha_m2_per_mm2", "score"},
        {}};
    for (std::size_t j = 0; j < problems_.points(); ++j) {
      const Position at{problems_.position(j, 0)[0], problems_.position(j, 1)[0], problems_.position(j, 2)[0]};
      const double measured = problems_.measured(j)[0];
      const bool images = problems_.has_images();
      objects.add_row(static_cast<std::int64_t>(j + 1), at[0], at[1], at[2], distance(at, truth_),
                      images ? Field() : Field(measured), images ? Field(measured) : Field(),
                      images ? Field(problems_.alpha(j)[0]) : Field(),
                      problems_.has_scores() ? Field(problems_.score(j)[0]) : Field());
    }
    DataTable places{"camera", {"place", "x_m", "y_m", "z_m", "image_distance_mm"}, {}};
    places.add_row("truth", truth_[0], truth_[1], truth_[2], image_distance(true_distance_));
    places.add_row("start", problems_.start(0)[0], problems_.start(1)[0], problems_.start(2)[0],
                   problems_.has_images() ? Field(problems_.start_image_distance()[0]) : Field());
    return {objects, places};
  }

  DataTable iterations(const std::vector<solvers::TracedIterate>& iterates) const {
    DataTable table{"iterations",
                    {"iteration", "x_m", "y_m", "z_m", "image_distance_mm", "step_m", "rejected", "residual_rms_m", "k",
                     "condition", "weights"},
                    {}};
    for (const solvers::TracedIterate& at : iterates) {
      Field step;
      Field k;
      Field rejected;
      if (at.step) {
        step = if_number(at.step->length_m);
        if (at.step->is_rejected) rejected = true;
        if (!at.step->k.empty()) {
          const bool same = std::ranges::all_of(at.step->k, [&](double v) { return v == at.step->k[0]; });
          k = same ? Field(at.step->k[0]) : Field(at.step->k);
        }
      }
      table.add_row(static_cast<std::int64_t>(table.rows.size()), at.position[0], at.position[1], at.position[2],
                    image_distance(at.image_distance_mm), step, rejected, at.residual_rms_m, k, at.condition,
                    at.weights);
    }
    return table;
  }

  /// The first trial of both, which have been computed in different ways.
  DataTable outcome(const core::SolutionBatch& over_double, const core::SolutionBatch& packed, core::Isa isa) const {
    DataTable table{"outcome",
                    {"computed", "status", "iterations", "x_m", "y_m", "z_m", "image_distance_mm", "error_m",
                     "residual_rms_m", "remaining_step_m", "eta_first", "eta_last", "eta_mean", "difference_m"},
                    {}};
    const auto add = [&](std::string_view name, const core::SolutionBatch& s, const Field& difference) {
      const Position at = estimate_of(s);
      table.add_row(std::string(name), std::string(core::status_names[s.status[0]]),
                    static_cast<std::int64_t>(s.iterations[0]), at[0], at[1], at[2],
                    image_distance(s.image_distance_mm[0]), distance(at, truth_), s.residual_rms_m[0],
                    s.remaining_step_m[0], if_number(s.eta_first[0]), if_number(s.eta_last[0]),
                    if_number(s.eta_mean[0]), difference);
    };
    const Position a = estimate_of(over_double);
    const Position b = estimate_of(packed);
    double largest = 0.0;
    for (std::size_t axis = 0; axis < a.size(); ++axis) largest = std::max(largest, std::fabs(a[axis] - b[axis]));
    add("double", over_double, Field());
    add(core::name_of(isa), packed, largest);
    return table;
  }

  DataTable reference(const std::optional<Audit::Answers>& answers, const Position& estimate) const {
    DataTable table{"ceres",
                    {"from", "converged", "iterations", "x_m", "y_m", "z_m", "image_distance_mm", "error_m",
                     "from_estimate_m", "objective"},
                    {}};
    if (!answers) return table;
    const auto add = [&](const char* from, const solvers::Minimizer& m) {
      table.add_row(std::string(from), m.converged, static_cast<std::int64_t>(m.iterations), m.estimate[0],
                    m.estimate[1], m.estimate[2], image_distance(m.image_distance_mm), distance(m.estimate, truth_),
                    distance(m.estimate, estimate), m.cost);
    };
    add("start", answers->from_start);
    add("truth", answers->from_truth);
    return table;
  }

 private:
  Field image_distance(double value) const { return problems_.has_images() ? Field(value) : Field(); }

  const core::ProblemBatch& problems_;
  Position truth_;
  double true_distance_ = std::numeric_limits<double>::quiet_NaN();
};

/// What Ceres makes of a solver's objective. That of irls is known where the solver rests, and where it has failed not
/// at all.
std::optional<Audit::Answers> reference_of(const Method& method, const solvers::SolverOptions& options,
                                           const Audit& audit, const core::ProblemBatch& problems,
                                           const core::SolutionBatch& solution) {
  const auto objective = solvers::reference_objective(solvers::solver_named(method.solver), options);
  const bool converged = solution.status[0] == static_cast<std::uint8_t>(core::Status::Converged);
  if (!objective || (objective->loss == solvers::ReferenceLoss::Reweighted && !converged)) return std::nullopt;
  return audit.solve(
      0, solvers::at_estimate(*objective, problems, 0, {estimate_of(solution), solution.image_distance_mm[0]}));
}

}  // namespace

Replay replay_ranging(std::uint64_t seed, const Cell& cell, std::span<const Method> methods, std::uint64_t trial,
                      RangingScratch& scratch) {
  const RangingCell settings(cell.values);
  const core::Oracle oracle = simulate_ranging(seed, settings, {trial, 1}, scratch);
  const core::ProblemBatch& problems = scratch.problems;
  const EveryLane lanes(problems, oracle);
  const Audit audit(problems, oracle, {});
  const TrialTables tables(problems, oracle);

  Replay replay;
  replay.scene = tables.scene();
  std::vector<RangingPath> paths;
  core::SolutionBatch packed;
  for (const Method& method : methods) {
    const solvers::SolverOptions options = solver_options(cell.values, method.given);
    const solvers::SolverEntry& entry = solvers::solver_named(method.solver);
    core::SolutionBatch& solution = scratch.solutions;
    entry.solve(problems, options, &oracle, solution);
    entry.kernel(scratch.isa)(lanes.problems, options, &lanes.oracle, packed);
    RangingPath& path = paths.emplace_back();
    path.label = method.label;
    path.iterates = solvers::trace(method.solver, problems, 0, options, &oracle);
    path.status = static_cast<core::Status>(solution.status[0]);
    path.steps = solution.iterations[0];
    path.reference = reference_of(method, options, audit, problems, solution);
    replay.methods.push_back({method.label,
                              method.solver,
                              {tables.iterations(path.iterates), tables.outcome(solution, packed, scratch.isa),
                               tables.reference(path.reference, estimate_of(solution))}});
  }
  results::Drawing drawing = ranging_drawing(problems, oracle, solver_options(cell.values, {}), paths);
  if (settings.given) {
    // The camera looks nowhere.
    drawing.x_label = "x [m]";
    drawing.y_label = "y [m]";
  }
  replay.drawing = std::move(drawing);
  return replay;
}

}  // namespace ridgeloc::studies
