#include "studies/solving/pieces.hpp"

#include <algorithm>

namespace ridgeloc::studies {

namespace {

/// Iterations times points of a piece at most. One of them takes 5 ns (ols) to 80 ns (rrr with gcv) with AVX2 and up to
/// five times as much on the baseline: 0.8 seconds at the worst.
constexpr double piece_cost = 2e6;

/// Trials first, first + 1, ... of what is known of a batch.
core::Oracle part_of(const core::Oracle& oracle, std::size_t first, std::size_t count) {
  core::Oracle part = oracle;
  for (auto& column : part.truth) column = column.subspan(first, count);
  if (!part.image_distance.empty()) part.image_distance = part.image_distance.subspan(first, count);
  part.first_trial += first;
  return part;
}

void copy_solutions(const core::SolutionBatch& from, std::size_t first, core::SolutionBatch& to) {
  const auto place = [&](const auto& part, auto& whole) {
    std::ranges::copy(part, whole.begin() + static_cast<std::ptrdiff_t>(first));
  };
  for (std::size_t axis = 0; axis < from.estimate.size(); ++axis) place(from.estimate[axis], to.estimate[axis]);
  for (const auto column :
       {&core::SolutionBatch::image_distance_mm, &core::SolutionBatch::iterations, &core::SolutionBatch::residual_rms_m,
        &core::SolutionBatch::remaining_step_m, &core::SolutionBatch::eta_first, &core::SolutionBatch::eta_last,
        &core::SolutionBatch::eta_mean}) {
    place(from.*column, to.*column);
  }
  place(from.status, to.status);
}

}  // namespace

std::size_t piece_trials(const solvers::SolverOptions& options, std::size_t points) {
  const double cost = static_cast<double>(options.max_iterations) * static_cast<double>(points);
  return std::max(static_cast<std::size_t>(piece_cost / std::max(cost, 1.0)), core::ProblemBatch::largest_lanes / 2);
}

bool solve_in_pieces(solvers::Solver solver, const core::ProblemBatch& problems, const solvers::SolverOptions& options,
                     const core::Oracle& oracle, core::SolutionBatch& out, PieceMemory& memory,
                     const Monitor& monitor) {
  const std::size_t trials = problems.trials();
  const std::size_t most = piece_trials(options, problems.points());
  if (trials <= most) {
    solver(problems, options, &oracle, out);
    return !monitor.stop_requested();
  }
  out.reshape(trials);
  for (std::size_t first = 0; first < trials; first += most) {
    if (monitor.stop_requested()) return false;
    const std::size_t count = std::min(most, trials - first);
    memory.problems.reshape(problems.points(), count);
    if (problems.has_scores()) memory.problems.add_scores();
    if (problems.has_images()) memory.problems.add_images();
    for (std::size_t t = 0; t < count; ++t) memory.problems.copy_trial(problems, first + t, t);
    const core::Oracle part = part_of(oracle, first, count);
    solver(memory.problems, options, &part, memory.solutions);
    copy_solutions(memory.solutions, first, out);
  }
  return !monitor.stop_requested();
}

}  // namespace ridgeloc::studies
