// What every solver says of problems that have no good answer.

#include <limits>
#include <string>
#include <vector>

#include "tests/support/all_methods.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hand_scene.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
const std::vector<Point> good = {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {-2, 1, 1}, {1, -2, 1}};
const std::vector<double> near = {2.1, 1.9, 2.0, 2.5, 2.4};

core::Status outcome(const char* solver, const core::ProblemBatch& p, const solvers::SolverOptions& options = {}) {
  return status(solve(solver, p, options));
}

const char* const iterating[] = {"ols", "lm", "dogleg", "rr", "rrr", "irls", "gn_prior"};
const char* const all[] = {"ols", "lm", "dogleg", "rr", "rrr", "irls", "gn_prior", "linear", "bancroft"};

}  // namespace

TEST_CASE("a good problem converges") {
  for (const char* solver : all) {
    INFO(solver);
    CHECK(outcome(solver, problem(good, near, {0.1, 0.1, 0.1})) == core::Status::Converged);
  }
}

TEST_CASE("points on one line, in one plane with the start, and all the same, are singular") {
  const auto line = problem({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, {1.1, 2.1, 3.2, 4.0}, {0, 0, 0});
  const auto plane = problem({{1, 2, 0}, {2, -1, 0}, {-3, 1, 0}, {4, 2, 0}}, {2.1, 2.1, 3.2, 4.0}, {0, 0, 0});
  const auto point = problem({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, {3.1, 3.9, 3.5, 3.7}, {0, 0, 0});
  for (const auto* p : {&line, &plane, &point}) {
    for (const char* solver : all) {
      if (solver == std::string("dogleg")) continue;  // goes along the gradient
      INFO(solver);
      CHECK(outcome(solver, *p) == core::Status::Singular);
      CHECK(estimate(solve(solver, *p)) == Point{0, 0, 0});
    }
    CHECK(outcome("dogleg", *p) == core::Status::Converged);
  }
}

TEST_CASE("what is not a number, and a start on a point, end as non_finite") {
  auto measured = near;
  measured[1] = not_a_number;
  auto points = good;
  points[2][0] = not_a_number;
  for (const char* solver : all) {
    INFO(solver);
    CHECK(outcome(solver, problem(good, measured, {0, 0, 0})) == core::Status::NonFinite);
    CHECK(outcome(solver, problem(points, near, {0, 0, 0})) == core::Status::NonFinite);
    CHECK(outcome(solver, problem(good, near, {not_a_number, 0, 0})) == core::Status::NonFinite);
  }
  for (const char* solver : iterating) {
    INFO(solver);
    CHECK(outcome(solver, problem(good, near, good[0])) == core::Status::NonFinite);
  }
  // A closed form linearises nothing.
  CHECK(outcome("linear", problem(good, near, good[0])) == core::Status::Converged);
  CHECK(outcome("bancroft", problem(good, near, good[0])) == core::Status::Converged);
}

TEST_CASE("scores that are all zero are singular, one that is not a number is non_finite") {
  for (const char* solver : all) {
    INFO(solver);
    auto p = problem(good, near, {0, 0, 0});
    core::ProblemBatch scored;
    scored.reshape(good.size(), 1);
    scored.add_scores();
    for (std::size_t j = 0; j < good.size(); ++j) {
      for (std::size_t axis = 0; axis < 3; ++axis) scored.position(j, axis)[0] = p.position(j, axis)[0];
      scored.measured(j)[0] = near[j];
      scored.score(j)[0] = 0.0;
    }
    for (std::size_t axis = 0; axis < 3; ++axis) scored.start(axis)[0] = 0.0;
    const core::Status zeros = outcome(solver, scored);
    // Means over no weight are no numbers.
    CHECK(zeros == (solver == std::string("linear") ? core::Status::NonFinite : core::Status::Singular));
    for (std::size_t j = 1; j < good.size(); ++j) scored.score(j)[0] = 1.0;
    scored.score(0)[0] = not_a_number;
    CHECK(outcome(solver, scored) == core::Status::NonFinite);
  }
}

TEST_CASE("measurements from a million metres leave the domain, or are never reached") {
  const std::vector<double> far(5, 3e6);
  for (const char* solver : {"ols", "rr", "irls", "bancroft"}) {
    INFO(solver);
    const core::Status s = outcome(solver, problem(good, far, {0.1, 0.2, 0.3}));
    CHECK(s != core::Status::Converged);
  }
}

TEST_CASE("pseudoranges that have no root of v leave the domain") {
  core::ProblemBatch p = problem(good, {-50, -50, -50, -50, -50}, {0.1, 0.1, 0.1});
  p.add_images();
  for (std::size_t j = 0; j < 5; ++j) p.alpha(j)[0] = 0.25;
  p.start_image_distance()[0] = 4.0;  // 0.25 * 16 < 50
  for (const char* solver : iterating) {
    INFO(solver);
    const auto s = solve(solver, p);
    CHECK(status(s) == core::Status::LeftDomain);
    CHECK(s.iterations[0] <= 1.0);
  }
}

TEST_CASE("no steps allowed is the iteration limit, at the start") {
  solvers::SolverOptions options;
  options.max_iterations = 0;
  for (const char* solver : all) {
    const auto s = solve(solver, problem(good, near, {0.1, 0.2, 0.3}), options);
    CHECK(status(s) == core::Status::IterationLimit);
    CHECK(estimate(s) == Point{0.1, 0.2, 0.3});
  }
}
