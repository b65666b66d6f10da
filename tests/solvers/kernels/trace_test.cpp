#include "solvers/kernels/trace.hpp"

#include <cmath>
#include <random>

#include "core/status.hpp"
#include "tests/support/all_methods.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hand_scene.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/sample.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;
using solvers::TracedIterate;

namespace {

constexpr std::size_t trials = 6;

/// Samples with what a simulation knows of them. Starts are up to 6 m off, so that some trials fail.
struct Batch {
  core::ProblemBatch problems;
  std::array<std::vector<double>, 3> truth;
  std::vector<double> image_distance;
  core::Oracle oracle;

  Batch(std::size_t points, bool images) {
    std::mt19937_64 engine(points);
    std::vector<Sample> samples;
    for (std::size_t t = 0; t < trials; ++t) {
      samples.push_back(random_sample(
          engine, {.points = points, .images = images, .scores = points == 6, .sigma_m = 0.3, .offset_m = 6.0}));
      for (std::size_t axis = 0; axis < 3; ++axis) truth[axis].push_back(samples.back().truth[axis]);
      image_distance.push_back(samples.back().image_distance);
    }
    problems = batch_of(samples);
    for (std::size_t axis = 0; axis < 3; ++axis) oracle.truth[axis] = truth[axis];
    if (images) oracle.image_distance = image_distance;
    oracle.range_sigma_m = 0.3;
    oracle.k_error = core::Stream(2018, "k_error");
    oracle.first_trial = 40;
  }
};

/// How many trials end elsewhere, after another number of steps or with another residual than those of the solver.
std::size_t differing(const MethodChoice& method, const Batch& batch) {
  core::SolutionBatch solutions;
  method.entry->solve(batch.problems, method.options, &batch.oracle, solutions);
  std::size_t count = 0;
  for (std::size_t t = 0; t < trials; ++t) {
    const auto iterates = solvers::trace(method.entry->name, batch.problems, t, method.options, &batch.oracle);
    const TracedIterate& last = iterates.back();
    bool same = static_cast<double>(iterates.size() - 1) == solutions.iterations[t];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      same = same && tests::same_bits_or_nan(last.position[axis], solutions.estimate[axis][t]);
    }
    if (batch.problems.has_images()) {
      same = same && tests::same_bits_or_nan(last.image_distance_mm, solutions.image_distance_mm[t]);
    } else {
      same = same && tests::same_bits_or_nan(last.residual_rms_m, solutions.residual_rms_m[t]);
    }
    same = same && last.weights.size() == batch.problems.points();
    count += same ? 0 : 1;
  }
  return count;
}

}  // namespace

TEST_CASE("a trace ends where the solver does, bit for bit") {
  auto methods = methods_by_k();
  const auto by_option = methods_by_option();
  methods.insert(methods.end(), by_option.begin(), by_option.end());
  for (const std::size_t points : {3, 5, 6, 11}) {
    const Batch batch(points, false);
    for (const MethodChoice& method : methods) {
      INFO(method.name << ", " << points << " points");
      CHECK(differing(method, batch) == 0);
    }
  }
  const Batch ranges(5, false);
  for (MethodChoice method : methods) {
    method.options.z_mode = solvers::ZMode::Fixed;
    INFO(method.name << ", known height");
    CHECK(differing(method, ranges) == 0);
  }
  const Batch images(6, true);
  for (const ModelChoice& model : pseudorange_models()) {
    for (MethodChoice method : methods) {
      apply(model, method.options);
      INFO(method.name << ", " << name_of(model));
      CHECK(differing(method, images) == 0);
    }
  }
}

TEST_CASE("a trace tells step, residuals, weights and condition") {
  // J'J is the identity at the start: the step of least squares is the residuals themselves.
  const auto iterates = solvers::trace("ols", axes_problem(0.1, -0.2, 0.3), 0, steps(1), nullptr);
  REQUIRE(iterates.size() == 2);
  CHECK(iterates[0].position == Point{0, 0, 0});
  CHECK(iterates[0].residual_rms_m == Approx(std::sqrt(0.14 / 3.0)));
  CHECK(iterates[0].weights == std::vector<double>{1, 1, 1});
  CHECK(iterates[0].condition == Approx(1.0));
  REQUIRE(iterates[0].step);
  CHECK(iterates[0].step->length_m == Approx(std::sqrt(0.14)));
  CHECK_FALSE(iterates[0].step->is_rejected);
  CHECK(iterates[0].step->k.empty());
  CHECK_FALSE(iterates[1].step);
  CHECK(distance(iterates[1].position, {0.1, -0.2, 0.3}) < 1e-15);
}

TEST_CASE("a trace tells K and robust weights") {
  auto options = steps(1);
  options.k = k_index("fixed");
  options.k_fixed = 0.25;
  options.irls_min_n = 3;
  const auto iterates = solvers::trace("rrr", axes_problem(0.1, -0.02, 0.4), 0, options, nullptr);
  CHECK(iterates[0].step->k == std::vector<double>{0.25, 0.25, 0.25});
  REQUIRE(iterates[0].weights.size() == 3);
  CHECK(iterates[0].weights[0] == Approx(10.0));
  CHECK(iterates[0].weights[1] == Approx(20.0));  // theta is 0.05
  CHECK(iterates[0].weights[2] == Approx(2.5));
  CHECK(iterates[0].condition == Approx(8.0));
}

TEST_CASE("a trace ends with the step that could not be taken") {
  const auto p = problem({{2, 0, 0}, {2, 0, 0}, {2, 0, 0}}, {2, 2, 2}, {0, 0, 0});
  const auto iterates = solvers::trace("ols", p, 0, {}, nullptr);
  REQUIRE(iterates.size() == 1);
  REQUIRE(iterates[0].step);
  CHECK(std::isnan(iterates[0].step->length_m));
  CHECK(std::isinf(iterates[0].condition));
}

TEST_CASE("a rejected step leads nowhere, and its length is told") {
  // The point lies between start and minimum: a full step along the axis overshoots.
  const auto p = problem({{1, 0, 0}, {0, 9, 0}, {0, 0, 9}, {30, 0, 0}}, {12, 15, 15, 5}, {0.5, 0.5, 0.5});
  for (const auto variant : {solvers::LmVariant::Lazy, solvers::LmVariant::Marquardt, solvers::LmVariant::More}) {
    for (const char* solver : {"lm", "dogleg"}) {
      solvers::SolverOptions options;
      options.lm_variant = variant;
      options.trust_radius_m = 100.0;
      const auto iterates = solvers::trace(solver, p, 0, options, nullptr);
      std::size_t rejected = 0;
      for (std::size_t i = 0; i + 1 < iterates.size(); ++i) {
        if (!iterates[i].step->is_rejected) continue;
        ++rejected;
        CHECK(iterates[i].step->length_m > options.step_tolerance_m);
        CHECK(iterates[i + 1].position == iterates[i].position);
      }
      INFO(solver);
      CHECK(rejected > 0);
    }
  }
  // The first step of lm is that of least squares.
  const double first = solvers::trace("ols", p, 0, {}, nullptr)[0].step->length_m;
  CHECK(solvers::trace("lm", p, 0, {}, nullptr)[0].step->length_m == first);
}
