#include "bench/ours.hpp"

#include <cstdlib>

#include "bench/stop.hpp"
#include "core/isa.hpp"
#include "sim/kernels.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::bench {

namespace {

constexpr std::uint64_t seed = 2018;

/// A minimum is found when Gauss-Newton's steps are this short (m): far below the tolerance of any check, far above
/// rounding.
constexpr double minimum_tolerance_m = 1e-10;
constexpr int minimum_max_iterations = 10'000;

template <core::Isa isa>
void generate_on(std::uint64_t first_trial, core::ProblemBatch& problems) {
  static const sim::FieldOfView view = [] {
    sim::FieldOfView defaults;
    defaults.start_offset_m = start_offset_m();
    return defaults;
  }();
  static const sim::SceneStreams streams(seed, view);
  static const auto& noise = sim::noise_registry()[0];
  static const core::Stream noise_stream(seed, "noise", noise.name);
  static const sim::Kernels scene = sim::kernels(isa);
  scene.place_objects(view, streams, first_trial, problems);
  scene.measure_ranges(noise, {.range_sigma_m = range_sigma_m}, noise_stream, first_trial, problems);
}

}  // namespace

double start_offset_m() {
  const char* given = std::getenv("RIDGELOC_BENCH_START_M");
  return given == nullptr ? sim::FieldOfView{}.start_offset_m : std::stod(given);
}

std::vector<OwnSolver> own_solvers() {
  std::vector<OwnSolver> all;
  for (const auto& entry : solvers::solver_registry()) {
    all.push_back({std::string(entry.name) + "/double", entry.solve});
    for (std::size_t i = 0; i < core::isa_count; ++i) {
      const auto isa = static_cast<core::Isa>(i);
      if (!core::is_supported(isa)) continue;
      all.push_back({std::string(entry.name) + "/" + std::string(core::name_of(isa)), entry.kernel(isa)});
    }
  }
  return all;
}

const solvers::SolverOptions& matched_options() {
  static const auto options = [] {
    solvers::SolverOptions matched;
    matched.step_tolerance_m = step_tolerance_m;
    matched.max_iterations = max_steps;
    matched.k = *solvers::find_k_estimator("kibria_gm");
    return matched;
  }();
  return options;
}

std::vector<OwnGenerator> own_generators() {
  std::vector<OwnGenerator> all;
  const auto add = [&all](core::Isa isa, Generator generate) {
    if (core::is_supported(isa)) all.push_back({std::string(core::name_of(isa)), generate});
  };
  add(core::Isa::Baseline, generate_on<core::Isa::Baseline>);
  add(core::Isa::Avx2, generate_on<core::Isa::Avx2>);
  add(core::Isa::Avx512, generate_on<core::Isa::Avx512>);
  return all;
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
  solvers::solver_named("ols").solve(problems, options, nullptr, solutions);
  return answers_of(solutions);
}

}  // namespace ridgeloc::bench
