#include "bench/ours.hpp"

#include "bench/stop.hpp"
#include "sim/field_of_view.hpp"
#include "sim/range_noise.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::bench {

namespace {

constexpr std::uint64_t seed = 2018;

/// A minimum is found when Gauss-Newton's steps are this short (m): far below the tolerance of any check, far above
/// rounding.
constexpr double minimum_tolerance_m = 1e-10;
constexpr int minimum_max_iterations = 10'000;

constexpr char ols[] = "ols";
constexpr char lm[] = "lm";
constexpr char rr[] = "rr";
constexpr char rrr[] = "rrr";

template <const char* name>
void solve_matched(const core::ProblemBatch& problems, core::SolutionBatch& out) {
  static const auto* solver = solvers::find_solver(name);
  static const auto options = [] {
    solvers::SolverOptions matched;
    matched.step_tolerance_m = step_tolerance_m;
    matched.max_iterations = max_steps;
    matched.k = *solvers::find_k_estimator("kibria_gm");
    return matched;
  }();
  solver->solve(problems, options, nullptr, out);
}

}  // namespace

std::vector<OwnEntry> own_solvers() {
  return {
      {"ols/double", solve_matched<ols>},
      {"lm/double", solve_matched<lm>},
      {"rr/double", solve_matched<rr>},
      {"rrr/double", solve_matched<rrr>},
  };
}

std::vector<Answer> answers_of(const core::SolutionBatch& solutions) {
  std::vector<Answer> answers;
  for (std::size_t trial = 0; trial < solutions.trials(); ++trial) {
    const std::array estimate = {solutions.estimate[0][trial], solutions.estimate[1][trial],
                                 solutions.estimate[2][trial]};
    const bool converged = solutions.status[trial] == static_cast<std::uint8_t>(core::Status::Converged);
    answers.push_back({estimate, solutions.iterations[trial], converged});
  }
  return answers;
}

std::vector<Answer> least_squares_minima(const core::ProblemBatch& problems) {
  solvers::SolverOptions options;
  options.step_tolerance_m = minimum_tolerance_m;
  options.max_iterations = minimum_max_iterations;
  core::SolutionBatch solutions;
  solvers::find_solver("ols")->solve(problems, options, nullptr, solutions);
  return answers_of(solutions);
}

void generate(std::uint64_t first_trial, core::ProblemBatch& problems) {
  static const sim::FieldOfView view;
  static const sim::SceneStreams streams(seed, view);
  static const auto& noise = sim::noise_registry()[0];
  static const core::Stream noise_stream(seed, "noise", noise.name);
  sim::place_objects(view, streams, first_trial, problems);
  sim::measure_ranges(noise, range_sigma_m, noise_stream, first_trial, problems);
}

}  // namespace ridgeloc::bench
