#include "studies/building/building_outcome.hpp"

#include "core/status.hpp"
#include "solvers/solver.hpp"
#include "studies/building/building_trials.hpp"

namespace ridgeloc::studies {

namespace {

core::Oracle oracle_of(const StartGroup& group, const solvers::SolverOptions& options) {
  core::Oracle oracle;
  for (std::size_t axis = 0; axis < core::position_parameters; ++axis) oracle.truth[axis] = group.truth[axis];
  oracle.image_distance = group.image_distance;
  oracle.range_sigma_m = options.sigma_prior_m;
  return oracle;
}

/// Adds one start that has converged inside the map.
void add(double x_m, double y_m, double iterations, PhotoOutcome& outcome) {
  outcome.x_m += x_m;
  outcome.y_m += y_m;
  outcome.iterations += iterations;
  ++outcome.inside;
}

void finish(const PhotoRecord& photo, PhotoOutcome& outcome) {
  if (!photo.is_taken) outcome.status = PhotoStatus::NoPhoto;
  if (outcome.starts == 0) return;
  outcome.status = outcome.converged == 0 ? PhotoStatus::Diverged : PhotoStatus::OutsideMap;
  if (outcome.inside == 0) return;
  outcome.status = PhotoStatus::Success;
  const auto n = static_cast<double>(outcome.inside);
  outcome.x_m /= n;
  outcome.y_m /= n;
  outcome.iterations /= n;
  outcome.error_m = sim::distance_m({outcome.x_m, outcome.y_m}, photo.truth_m);
}

}  // namespace

bool locate(const sim::BuildingMap& map, const Method& method, const solvers::SolverOptions& options,
            const Monitor& monitor, BuildingScratch& scratch) {
  const solvers::Solver solve = solvers::solver_named(method.solver).kernel(scratch.isa);
  scratch.ends.assign(scratch.starts.size(), {});
  for (const StartGroup& group : scratch.groups) {
    if (group.starts.empty()) continue;
    const core::Oracle oracle = oracle_of(group, options);
    if (!solve_in_pieces(solve, group.problems, options, oracle, scratch.solutions, scratch.piece, monitor))
      return false;
    const core::SolutionBatch& s = scratch.solutions;
    for (std::size_t t = 0; t < group.starts.size(); ++t) {
      StartEnd& end = scratch.ends[group.starts[t]];
      end = {static_cast<core::Status>(s.status[t]), {s.estimate[0][t], s.estimate[1][t]}, s.iterations[t]};
    }
  }
  // In the order of the starts, so that sums do not depend on how they are grouped.
  scratch.outcomes.assign(scratch.photos.size(), {});
  for (std::size_t i = 0; i < scratch.starts.size(); ++i) {
    PhotoOutcome& outcome = scratch.outcomes[scratch.starts[i].photo];
    const StartEnd& end = scratch.ends[i];
    ++outcome.starts;
    if (end.status != core::Status::Converged) continue;
    ++outcome.converged;
    if (map.is_inside(end.place_m)) add(end.place_m[0], end.place_m[1], end.iterations, outcome);
  }
  for (std::size_t p = 0; p < scratch.photos.size(); ++p) finish(scratch.photos[p], scratch.outcomes[p]);
  return true;
}

}  // namespace ridgeloc::studies
