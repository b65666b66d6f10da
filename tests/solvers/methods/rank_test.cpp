// Scenes that do not tell all unknowns, but for rounding: closed forms and normal matrices are not fooled by it.

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/sample.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

/// What all points of a scene have in common.
enum class Shape {
  Level,   ///< their height
  Plane,   ///< a tilted plane
  Line,    ///< a line
  Nearly,  ///< nearly a tilted plane: a millimetre off
};

constexpr std::size_t scenes = 40;

/// Scenes about places `far` m from the origin, the start a few metres from there, on the line or plane if `within`.
core::ProblemBatch batch(Shape shape, std::size_t points, double far, bool images, bool within = false) {
  std::mt19937_64 engine(61 + points);
  std::vector<Sample> samples;
  for (std::size_t t = 0; t < scenes; ++t) {
    Sample sample = random_sample(engine, {.points = points, .images = images, .offset_m = 3.0});
    const Point origin{far * normal(engine), far * normal(engine), far * normal(engine)};
    const Point slope{normal(engine), normal(engine), normal(engine)};
    const auto moved = [&](Point p, double off) {
      if (shape == Shape::Level) p[2] = 0.0;
      if (shape == Shape::Plane || shape == Shape::Nearly) p[2] = slope[0] * p[0] + slope[1] * p[1] + off;
      if (shape == Shape::Line) p = {slope[0] * p[0], slope[1] * p[0], slope[2] * p[0]};
      for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += origin[axis];
      return p;
    };
    for (Point& p : sample.points) p = moved(p, shape == Shape::Nearly ? 1e-3 * uniform(engine, -1.0, 1.0) : 0.0);
    if (within) sample.start = moved(sample.start, 0.0);
    if (!within) {
      for (std::size_t axis = 0; axis < 3; ++axis) sample.start[axis] += origin[axis];
    }
    samples.push_back(sample);
  }
  return batch_of(samples);
}

/// How many trials end as singular, where they began.
std::size_t singular(const char* solver, const core::ProblemBatch& problems,
                     const solvers::SolverOptions& options = {}) {
  const auto s = solve(solver, problems, options);
  std::size_t count = 0;
  for (std::size_t t = 0; t < problems.trials(); ++t) {
    const Point start{problems.start(0)[t], problems.start(1)[t], problems.start(2)[t]};
    // Scaled unknowns return from the scale with a rounding.
    const double rounding = 1e-15 * (1.0 + std::hypot(start[0], start[1], start[2]));
    count += status(s, t) == core::Status::Singular && distance(estimate(s, t), start) <= rounding ? 1 : 0;
  }
  return count;
}

solvers::SolverOptions known(solvers::ZMode z_mode, solvers::VMode v_mode) {
  solvers::SolverOptions options;
  options.z_mode = z_mode;
  options.v_mode = v_mode;
  return options;
}

}  // namespace

TEST_CASE("closed forms tell points of a plane or a line from others, however far out and many they are") {
  for (const double far : {0.0, 100.0, 5e6}) {
    for (const std::size_t points : {5, 6, 8, 100, 1000}) {
      INFO(points << " points, " << far << " m out");
      for (const Shape shape : {Shape::Level, Shape::Plane, Shape::Line}) {
        CHECK(singular("linear", batch(shape, points, far, false)) == scenes);
      }
      CHECK(singular("bancroft", batch(Shape::Line, points, far, false)) == scenes);
      // Off a plane by a millimetre is not in it, and Bancroft's equations need no more than a plane.
      CHECK(singular("linear", batch(Shape::Nearly, points, far, false)) == 0);
      CHECK(singular("bancroft", batch(Shape::Plane, points, far, false)) == 0);
    }
  }
}

TEST_CASE("closed forms of pseudoranges do too, the height known or not") {
  using solvers::VMode;
  using solvers::ZMode;
  for (const VMode v_mode : {VMode::Free, VMode::Fixed}) {
    for (const std::size_t points : {5, 8, 100}) {
      INFO(points << " points, v " << (v_mode == VMode::Free ? "free" : "fixed"));
      for (const double far : {0.0, 100.0, 5e6}) {
        const auto space = known(ZMode::Free, v_mode);
        const auto level = known(ZMode::Fixed, v_mode);
        for (const Shape shape : {Shape::Level, Shape::Plane, Shape::Line}) {
          CHECK(singular("linear", batch(shape, points, far, true), space) == scenes);
        }
        CHECK(singular("linear", batch(Shape::Line, points, far, true), level) == scenes);
        CHECK(singular("linear", batch(Shape::Plane, points, far, true), level) == 0);
        CHECK(singular("linear", batch(Shape::Nearly, points, far, true), space) == 0);
        CHECK(singular("bancroft", batch(Shape::Line, points, far, true), space) == scenes);
      }
    }
  }
}

TEST_CASE("a method stays at the given start where the closed form has no answer but rounding") {
  auto options = steps(0);
  options.start = solvers::Start::Linear;
  for (const std::size_t points : {5, 8, 100}) {
    const auto problems = batch(Shape::Level, points, 100.0, false);
    const auto s = solve("ols", problems, options);
    for (std::size_t t = 0; t < scenes; ++t) {
      CHECK(estimate(s, t) == Point{problems.start(0)[t], problems.start(1)[t], problems.start(2)[t]});
    }
  }
}

TEST_CASE("the normal matrix of any number of points in a plane is singular at a point of it") {
  for (const std::size_t points : {3, 5, 100, 1000}) {
    INFO(points << " points");
    const auto problems = batch(Shape::Plane, points, 0.0, false, true);
    for (const char* solver : {"ols", "lm", "irls", "rr", "rrr"}) {
      INFO(solver);
      CHECK(singular(solver, problems) == scenes);
    }
    CHECK(singular("ols", batch(Shape::Nearly, points, 0.0, false, true)) == 0);
  }
}
