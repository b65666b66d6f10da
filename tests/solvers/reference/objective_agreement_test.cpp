// Every method that theory sends to a minimiser, run to |dx| < 1e-10 m or 10^4 iterations, against the reference.

#include <cmath>
#include <cstdio>
#include <string>

#include "sim/field_of_view.hpp"
#include "sim/range_noise.hpp"
#include "solvers/reference/ceres_reference.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hand_scene.hpp"
#include "tests/support/pseudorange_scene.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

constexpr std::size_t trials = 300;

core::ProblemBatch ranges(std::size_t points, bool known_height = false) {
  sim::FieldOfView view;
  view.start_at_height = known_height;
  core::ProblemBatch problems;
  problems.reshape(points, trials);
  sim::place_objects(view, sim::SceneStreams(2018, view), 0, problems);
  sim::measure_ranges(sim::noise_registry()[0], {.range_sigma_m = 0.1}, core::Stream(2018, "noise"), 0, problems);
  return problems;
}

/// Runs the solver to its end and counts what theory demands of where it is:
/// - the step that is left, by Ceres' gradient, equals the one that the solver reports, to rounding, and is shorter
/// than
///   the last but where only damping, or a scale that moves along, makes the iteration converge: a few in a hundred;
/// - Ceres, started there, finds a minimum (with a scale that moves along a saddle of the objective can be a place to
///   rest: 42 of 259 trials with geman_mcclure) within 1e-8 m, but for slow linear convergence.
void check_agreement(const std::string& what, const char* solver, solvers::SolverOptions options,
                     const core::ProblemBatch& problems) {
  options.k = k_index("fixed");
  options.step_tolerance_m = 1e-10;
  options.max_iterations = 10'000;
  const auto objective = solvers::reference_objective(solvers::solver_named(solver), options);
  REQUIRE(objective);
  const auto s = solve(solver, problems, options);
  std::size_t converged = 0;
  std::size_t judged = 0;
  std::size_t longer = 0;
  std::size_t different = 0;
  std::size_t minima = 0;
  std::size_t near = 0;
  double largest_gap_m = 0.0;
  for (std::size_t t = 0; t < problems.trials(); ++t) {
    if (status(s, t) != core::Status::Converged) continue;
    ++converged;
    const solvers::ReferencePlace place(estimate(s, t), s.image_distance_mm[t]);
    const auto own = solvers::at_estimate(*objective, problems, t, place);
    const auto step = solvers::undamped_step(problems, t, place, own);
    if (std::isnan(step.step_m)) continue;
    ++judged;
    longer += step.step_m > options.step_tolerance_m + step.step_error_m ? 1 : 0;
    different += std::fabs(step.step_m - s.remaining_step_m[t]) > step.step_error_m ? 1 : 0;
    const auto minimizer = solvers::minimize(problems, t, place, own);
    if (!minimizer.converged) continue;
    ++minima;
    const double gap = distance(place.position, minimizer.estimate);
    near += gap <= 1e-8 ? 1 : 0;
    if (gap <= 0.01) largest_gap_m = std::max(largest_gap_m, gap);
  }
  std::printf(
      "%s: %zu converged, %zu judged, %zu with longer steps, %zu with others, %zu minima, %zu within 1e-8 m, "
      "largest gap %.3g m\n",
      what.c_str(), converged, judged, longer, different, minima, near, largest_gap_m);
  CAPTURE(what);
  CHECK(converged > problems.trials() / 2);
  CHECK(judged > converged * 9 / 10);
  CHECK(different == 0);
  CHECK(longer <= judged / 20);
  CHECK(minima > judged * 3 / 4);
  CHECK(near > minima * 9 / 10);
}

}  // namespace

TEST_CASE("least squares by any method end at the reference", "[reference]") {
  const std::size_t points = GENERATE(4, 7);
  const core::ProblemBatch problems = ranges(points);
  for (const char* solver : {"ols", "dogleg"}) check_agreement(solver, solver, {}, problems);
  for (const auto variant : {solvers::LmVariant::Lazy, solvers::LmVariant::Marquardt, solvers::LmVariant::More}) {
    solvers::SolverOptions options;
    options.lm_variant = variant;
    check_agreement("lm " + std::string(solvers::lm_variant_names[static_cast<std::size_t>(variant)]), "lm", options,
                    problems);
  }
}

TEST_CASE("reweighting ends at the reference, whatever the weight", "[reference]") {
  const core::ProblemBatch problems = ranges(7);
  check_agreement("rrr", "rrr", {}, problems);
  for (std::size_t weight = 0; weight < solvers::weight_registry().size(); ++weight) {
    for (const auto scale : {solvers::Scale::Mad, solvers::Scale::Fixed}) {
      solvers::SolverOptions options;
      options.weight = weight;
      options.scale = scale;
      const auto name = std::string("irls ") + std::string(solvers::weight_registry()[weight].name) +
                        (scale == solvers::Scale::Mad ? ", MAD" : ", fixed scale");
      check_agreement(name, "irls", options, problems);
    }
  }
}

TEST_CASE("methods on ranges of known height end at the reference", "[reference]") {
  const core::ProblemBatch problems = ranges(5, true);
  solvers::SolverOptions options;
  options.z_mode = solvers::ZMode::Fixed;
  for (const char* solver : {"ols", "lm", "dogleg", "rrr", "irls"})
    check_agreement(std::string(solver) + ", known height", solver, options, problems);
}

TEST_CASE("methods on pseudoranges end at the reference, whatever is known", "[reference]") {
  const core::ProblemBatch problems = pseudorange_scenes(7, trials, 0.05, 11);
  for (const auto v_mode : {solvers::VMode::Free, solvers::VMode::Fixed, solvers::VMode::Prior}) {
    for (const auto z_mode : {solvers::ZMode::Free, solvers::ZMode::Fixed}) {
      solvers::SolverOptions options;
      options.v_mode = v_mode;
      options.z_mode = z_mode;
      const auto name = [&](const char* solver) {
        return std::string(solver) + ", v " + std::string(solvers::v_mode_names[static_cast<std::size_t>(v_mode)]) +
               ", z " + std::string(solvers::z_mode_names[static_cast<std::size_t>(z_mode)]);
      };
      for (const char* solver : {"ols", "gn_prior", "rrr"}) check_agreement(name(solver), solver, options, problems);
    }
  }
}
