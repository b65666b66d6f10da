// Instruction sets with a fused multiply-add round differently from the double path. How far that goes, over many
// trials.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>
#include <vector>

#include "sim/field_of_view.hpp"
#include "sim/range_noise.hpp"
#include "solvers/solver.hpp"
#include "tests/support/all_methods.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

constexpr std::size_t block = 4096;
constexpr double usual_tolerance_m = 1e-9;
// gcv's golden section knows k to 2e-4 and may go either way where its score is flat to rounding: that much of a step,
// the last of which is shorter than 0.05 m.
constexpr double gcv_tolerance_m = 2e-4 * 0.05;

struct Differences {
  std::uint64_t both_converged = 0;
  std::uint64_t other_iterations = 0;  ///< of those
  std::uint64_t other_status = 0;      ///< of all
  double largest_m = 0.0;              ///< of those that converged after equally many iterations
  std::uint64_t beyond = 0;            ///< of those: further apart than the tolerance
};

Differences compare(const solvers::SolverEntry& entry, const solvers::SolverOptions& options, core::Isa isa,
                    std::size_t points, std::uint64_t trials, double tolerance_m) {
  sim::FieldOfView view;
  const sim::SceneStreams streams(2018, view);
  const core::Stream noise(2018, "noise", "normal");
  core::ProblemBatch problems;
  core::SolutionBatch reference;
  core::SolutionBatch packed;
  Differences d;
  for (std::uint64_t first = 0; first < trials; first += block) {
    problems.reshape(points, block);
    sim::place_objects(view, streams, first, problems);
    sim::measure_ranges(sim::noise_registry()[0], {.range_sigma_m = 0.1}, noise, first, problems);
    entry.solve(problems, options, nullptr, reference);
    entry.kernel(isa)(problems, options, nullptr, packed);
    for (std::size_t t = 0; t < block; ++t) {
      d.other_status += reference.status[t] == packed.status[t] ? 0 : 1;
      if (reference.status[t] != 0 || packed.status[t] != 0) continue;
      ++d.both_converged;
      if (reference.iterations[t] != packed.iterations[t]) {
        ++d.other_iterations;
        continue;
      }
      double squared = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double gap = reference.estimate[axis][t] - packed.estimate[axis][t];
        squared += gap * gap;
      }
      d.largest_m = std::max(d.largest_m, std::sqrt(squared));
      d.beyond += std::sqrt(squared) > tolerance_m ? 1 : 0;
    }
  }
  return d;
}

/// Prints a line and returns how many trials differ, of how many.
double share_differing(const solvers::SolverEntry& entry, const solvers::SolverOptions& options, std::string_view name,
                       std::size_t points, std::uint64_t trials) {
  const core::Isa isa = core::best_isa();
  const bool gcv = name.ends_with("gcv");
  const double tolerance_m = gcv ? gcv_tolerance_m : usual_tolerance_m;
  const Differences d = compare(entry, options, isa, points, trials, tolerance_m);
  std::printf(
      "%s, %zu points, %s against double: %llu of %llu both converged, %llu with other iterations, %llu with another "
      "status, largest gap %.1e m, %llu beyond %.0e m\n",
      name.data(), points, core::name_of(isa).data(), static_cast<unsigned long long>(d.both_converged),
      static_cast<unsigned long long>(trials), static_cast<unsigned long long>(d.other_iterations),
      static_cast<unsigned long long>(d.other_status), d.largest_m, static_cast<unsigned long long>(d.beyond),
      tolerance_m);
  return static_cast<double>(d.other_iterations + d.other_status + d.beyond) / static_cast<double>(trials);
}

}  // namespace

TEST_CASE("fused and plain arithmetic agree but for trials that amplify rounding") {
  // Such trials pass near a singular matrix: at most one in 10^4 for 5 and 7 points.
  for (const std::size_t points : {5, 7}) {
    for (const char* name : {"ols", "lm", "rr", "rrr"}) {
      CHECK(share_differing(solvers::solver_named(name), {}, name, points, 1'000'000) <= 1e-4);
    }
  }
}

TEST_CASE("fused and plain arithmetic agree for the other solvers and estimators of K") {
  constexpr std::uint64_t trials = 50 * block;
  auto methods = methods_by_k();
  for (const MethodChoice& method : methods_by_option()) {
    if (method.options.lm_variant != solvers::LmVariant::Lazy) methods.push_back(method);
  }
  for (const MethodChoice& method : methods) {
    const auto& estimator = solvers::k_estimator_registry()[method.options.k];
    if (estimator.needs_oracle) continue;
    CHECK(share_differing(*method.entry, method.options, method.name, 7, trials) <= 1e-4);
  }
}
