// Closed forms, on their own and as a start.

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/all_methods.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eigen_model.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

constexpr double exact_m = 1e-7;  // lifted equations square lengths of 10 m and their condition: 10^8 eps and more

/// How many of many exact problems a closed form solves to `exact_m`.
int solved(const char* solver, const SampleShape& shape, const solvers::SolverOptions& options) {
  std::mt19937_64 engine(41 + shape.points);
  int count = 0;
  for (int i = 0; i < 100; ++i) {
    Sample sample = random_sample(engine, shape);
    if (options.z_mode == solvers::ZMode::Fixed) sample.start[2] = sample.truth[2];
    if (options.v_mode == solvers::VMode::Fixed) sample.start_image_distance = sample.image_distance;
    const auto s = solve(solver, batch_of({sample}), options);
    if (status(s) != core::Status::Converged) continue;
    CHECK(s.iterations[0] == 1.0);
    count += distance(estimate(s), sample.truth) < exact_m ? 1 : 0;
  }
  return count;
}

}  // namespace

TEST_CASE("linear and bancroft are exact on ranges without noise, from any start") {
  for (std::size_t points = 4; points <= 8; ++points) {
    const SampleShape shape{.points = points, .scores = points % 2 == 0, .sigma_m = 0.0, .offset_m = 20.0};
    INFO(points << " points");
    // A few of a hundred random scenes are so flat that rounding shows.
    CHECK(solved("linear", shape, {}) >= 95);
    CHECK(solved("bancroft", shape, {}) >= 95);
  }
}

TEST_CASE("linear and bancroft are exact on ranges without noise and a known height") {
  solvers::SolverOptions options;
  options.z_mode = solvers::ZMode::Fixed;
  for (std::size_t points = 3; points <= 8; ++points) {
    const SampleShape shape{.points = points, .scores = points % 2 == 0, .sigma_m = 0.0, .offset_m = 20.0};
    INFO(points << " points");
    CHECK(solved("linear", shape, options) >= 95);
    CHECK(solved("bancroft", shape, options) >= 95);
  }
  // With two ranges two circles meet in two points: the one nearer to the start.
  const auto p = problem({{3, 0, 1}, {-2, 0, -1}},
                         {distance({3, 0, 1}, {0.5, 2, 0.25}), distance({-2, 0, -1}, {0.5, 2, 0.25})}, {0, 1, 0.25});
  CHECK(distance(estimate(solve("bancroft", p, options)), {0.5, 2, 0.25}) < 1e-12);
  CHECK(status(solve("linear", p, options)) == core::Status::Singular);
}

TEST_CASE("bancroft on three ranges takes the root nearer to the start, linear has no answer") {
  const std::vector<Point> plane = {{3, 0, 0}, {-2, 2, 0}, {0, -3, 0}};
  for (const double side : {1.0, -1.0}) {
    const Point above{0.3, 0.2, 1.5 * side};
    std::vector<double> measured;
    for (const Point& p : plane) measured.push_back(distance(p, above));
    for (const double height : {0.1, 1.0, 4.0}) {
      const auto p = problem(plane, measured, {0.5, -0.5, height * side});
      const auto s = solve("bancroft", p, {});
      CHECK(status(s) == core::Status::Converged);
      CHECK(distance(estimate(s), above) < 1e-12);
      CHECK(status(solve("linear", p, {})) == core::Status::Singular);
    }
  }
}

TEST_CASE("closed forms are exact on pseudoranges without noise, height and image distance known or not") {
  for (const auto z_mode : {solvers::ZMode::Free, solvers::ZMode::Fixed}) {
    for (const auto v_mode : {solvers::VMode::Free, solvers::VMode::Fixed}) {
      solvers::SolverOptions options;
      options.z_mode = z_mode;
      options.v_mode = v_mode;
      const std::size_t unknowns =
          (z_mode == solvers::ZMode::Free ? 3U : 2U) + (v_mode == solvers::VMode::Free ? 1U : 0U);
      for (std::size_t points = unknowns + 1; points <= 8; ++points) {
        const SampleShape shape{.points = points, .images = true, .sigma_m = 0.0, .offset_m = 5.0};
        INFO(points << " points, " << unknowns << " unknowns");
        CHECK(solved("linear", shape, options) >= 90);
        CHECK(solved("bancroft", shape, options) >= 90);
      }
      // As many points as unknowns: the right one of two roots from nearby.
      const SampleShape few{.points = unknowns, .images = true, .sigma_m = 0.0, .offset_m = 0.05};
      if (unknowns >= 3) CHECK(solved("bancroft", few, options) >= 80);
      CHECK(solved("linear", few, options) == 0);
    }
  }
}

TEST_CASE("linear minimises the lifted equations with squared scores") {
  std::mt19937_64 engine(42);
  for (int i = 0; i < 50; ++i) {
    const Sample sample = random_sample(engine, {.points = 6, .scores = true, .sigma_m = 0.5});
    // -2 p'x + q = m^2 - p'p, unknowns x and q.
    Matrix rows(6, 4);
    Column right(6);
    for (long j = 0; j < 6; ++j) {
      const auto index = static_cast<std::size_t>(j);
      const Column p = Eigen::Map<const Eigen::Vector3d>(sample.points[index].data()).cast<long double>();
      const long double s = sample.score[index];
      rows.row(j) << -2.0L * s * p.transpose(), s;
      right(j) = s * (std::pow(static_cast<long double>(sample.measured[index]), 2.0L) - p.squaredNorm());
    }
    const Column x = rows.colPivHouseholderQr().solve(right);
    const Point expected{static_cast<double>(x(0)), static_cast<double>(x(1)), static_cast<double>(x(2))};
    CHECK(distance(estimate(solve("linear", batch_of({sample}), {})), expected) < 1e-8);
  }
}

TEST_CASE("a method starts at a closed form, or at the given start where there is none") {
  std::mt19937_64 engine(43);
  for (int i = 0; i < 20; ++i) {
    const Sample sample = random_sample(engine, {.points = 6, .sigma_m = 0.3, .offset_m = 5.0});
    for (const char* form : {"linear", "bancroft"}) {
      Sample moved = sample;
      moved.start = estimate(solve(form, batch_of({sample}), {}));
      auto options = steps(2);
      const Point given = estimate(solve("ols", batch_of({moved}), options));
      options.start = form == std::string("linear") ? solvers::Start::Linear : solvers::Start::Bancroft;
      CHECK(distance(estimate(solve("ols", batch_of({sample}), options)), given) < 1e-9);
    }
  }
  const auto three = batch_of({random_sample(engine, {.points = 3})});
  auto options = steps(2);
  const Point given = estimate(solve("ols", three, options));
  options.start = solvers::Start::Linear;
  CHECK(estimate(solve("ols", three, options)) == given);
  const auto line = problem({{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, {1.1, 2.1, 3.2, 4.0}, {0.2, 0.3, 0.1});
  for (const auto start : {solvers::Start::Linear, solvers::Start::Bancroft}) {
    options.start = start;
    options.max_iterations = 0;
    CHECK(estimate(solve("dogleg", line, options)) == Point{0.2, 0.3, 0.1});
  }
}

TEST_CASE("gn_prior is ols with v free for a vague prior, and with v fixed for a certain one") {
  std::mt19937_64 engine(44);
  for (int i = 0; i < 20; ++i) {
    const auto p = batch_of({random_sample(engine, {.points = 6, .images = true, .scores = true})});
    solvers::SolverOptions options;
    options.step_tolerance_m = 1e-11;
    options.max_iterations = 200;
    const auto at = [&](const char* solver, double sigma_m, solvers::VMode v_mode) {
      options.sigma_prior_m = sigma_m;
      options.v_mode = v_mode;
      return solve(solver, p, options);
    };
    const auto fixed = at("ols", 0.1, solvers::VMode::Fixed);
    const auto free = at("ols", 0.1, solvers::VMode::Free);
    if (status(fixed) != core::Status::Converged || status(free) != core::Status::Converged) continue;
    // A weight (sigma / (0.005 v))^2 of 10^12 leaves 10^-12 of v's freedom, one of 10^-15 changes as little.
    CHECK(distance(estimate(at("gn_prior", 2e4, solvers::VMode::Fixed)), estimate(fixed)) < 1e-6);
    CHECK(distance(estimate(at("gn_prior", 1e-9, solvers::VMode::Fixed)), estimate(free)) < 1e-6);
    CHECK(distance(estimate(at("gn_prior", 0.1, solvers::VMode::Fixed)), estimate(free)) > 1e-6);
    CHECK(estimate(at("gn_prior", 0.1, solvers::VMode::Free)) == estimate(at("ols", 0.1, solvers::VMode::Prior)));
  }
  const auto ranges = batch_of({random_sample(engine, {.points = 6})});
  CHECK(estimate(solve("gn_prior", ranges, {})) == estimate(solve("ols", ranges, {})));
}
