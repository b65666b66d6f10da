// lm with lm_variant = marquardt, and dogleg: by hand and against transcriptions with Eigen in long double.

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "tests/support/catch.hpp"
#include "tests/support/eigen_model.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

/// Calls f(sample, options, i) for ranges and pseudoranges that start far off.
template <class F>
void for_each_problem(F f) {
  std::mt19937_64 engine(21);
  for (int i = 0; i < 30; ++i) {
    const bool images = i % 3 == 2;
    solvers::SolverOptions options;
    options.v_mode = i % 2 == 0 ? solvers::VMode::Free : solvers::VMode::Prior;
    f(random_sample(engine, {.points = 5, .images = images, .scores = true, .sigma_m = 1.0, .offset_m = 12.0}), options,
      i);
  }
}

/// What a transcription did.
struct Seen {
  int accepted = 0;
  int rejected = 0;
  int newton = 0;
  int gradient = 0;
  int second_leg = 0;
};

void check_step(const Sample& sample, solvers::SolverOptions options, const char* solver, int count,
                const Point& expected) {
  options.max_iterations = count;
  options.step_tolerance_m = 1e-15;
  const auto s = solve(solver, batch_of({sample}), options);
  CAPTURE(count);
  CHECK(distance(estimate(s), expected) < 1e-8);
}

}  // namespace

TEST_CASE("marquardt damps from the start: 1e-3, a tenth on acceptance, ten times on rejection") {
  // J'J = I: the first step is divided by 1.001, the second by 1.0001.
  solvers::SolverOptions options = steps(1);
  options.lm_variant = solvers::LmVariant::Marquardt;
  CHECK(distance(estimate(solve("lm", axes_problem(0.1, -0.2, 0.3), options)),
                 {0.1 / 1.001, -0.2 / 1.001, 0.3 / 1.001}) < 1e-15);

  Seen seen;
  for_each_problem([&](const Sample& sample, solvers::SolverOptions how, int i) {
    how.lm_variant = solvers::LmVariant::Marquardt;
    const EigenModel model(sample, how);
    Column u = model.start();
    long double mu = 1e-3L;
    INFO("problem " << i);
    for (int count = 1; count <= 12; ++count) {
      const Matrix rows = model.weighted_rows(u);
      const Column errors = model.weighted_errors(u);
      Matrix a = rows.transpose() * rows;
      a.diagonal() *= 1.0L + mu;
      const Column du = a.ldlt().solve(rows.transpose() * errors);
      if (model.move(du) < 1e-6L) break;
      if (model.weighted_errors(u - du).squaredNorm() > errors.squaredNorm()) {
        mu *= 10.0L;
        ++seen.rejected;
      } else {
        u -= du;
        mu /= 10.0L;
        ++seen.accepted;
      }
      check_step(sample, how, "lm", count, model.position(u));
    }
  });
  CHECK(seen.accepted > 100);
  CHECK(seen.rejected > 10);
}

TEST_CASE("dogleg within its radius, along the gradient, and on the second leg") {
  // Two points in the direction of x, one each of y and z: J'J = diag(2, 1, 1), e = (0.4, 0.4, 0.2, 0.1), and the step
  // -dx = (0.4, 0.2, 0.1), g = J'e = -(0.8, 0.2, 0.1).
  const auto p = problem({{2, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 2}}, {1.6, 2.6, 1.8, 1.9}, {0, 0, 0});
  auto options = steps(1);
  CHECK(distance(estimate(solve("dogleg", p, options)), {0.4, 0.2, 0.1}) < 1e-15);
  options.trust_radius_m = 0.3;  // the gradient's minimum g (g'g / g'Hg), g'g = 0.69, g'Hg = 1.33, is 0.43 m long
  const double length = std::sqrt(0.69);
  CHECK(distance(estimate(solve("dogleg", p, options)), {0.24 / length, 0.06 / length, 0.03 / length}) < 1e-15);
  options.trust_radius_m = 0.45;  // between 0.43 and |dx| = 0.458
  const Point x = estimate(solve("dogleg", p, options));
  CHECK(distance(x, {0, 0, 0}) == Approx(0.45).epsilon(1e-14));
  const double t = 0.69 / 1.33;
  const Point cauchy{0.8 * t, 0.2 * t, 0.1 * t};
  // On the line from the gradient's minimum to the Gauss-Newton step.
  CHECK(distance(cauchy, x) + distance(x, {0.4, 0.2, 0.1}) == Approx(distance(cauchy, {0.4, 0.2, 0.1})).epsilon(1e-12));
}

TEST_CASE("dogleg walks along the gradient where J'J is singular") {
  // Points on the x axis, seen from it: J'J = diag(4, 0, 0), g = -(0.4, 0, 0), and g'g / g'Hg = 1/4.
  const auto line = problem({{2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}}, {1.9, 2.9, 3.8, 5.0}, {0, 0, 0});
  const auto s = solve("dogleg", line, {});
  CHECK(status(s) == core::Status::Converged);
  CHECK(distance(estimate(s), {0.1, 0.0, 0.0}) < 1e-14);
  // Nothing to gain and nothing known: no step at all.
  const auto exact = problem({{2, 0, 0}, {3, 0, 0}, {4, 0, 0}}, {2, 3, 4}, {0, 0, 0});
  CHECK(status(solve("dogleg", exact, {})) == core::Status::Singular);
}

TEST_CASE("dogleg follows Powell's path and radius") {
  Seen seen;
  for_each_problem([&](const Sample& sample, solvers::SolverOptions how, int i) {
    how.trust_radius_m = std::array{0.5, 3.0, 30.0}[static_cast<std::size_t>(i) / 3 % 3];
    const EigenModel model(sample, how);
    Column u = model.start();
    long double delta = how.trust_radius_m;
    INFO("problem " << i);
    for (int count = 1; count <= 15; ++count) {
      const Matrix rows = model.weighted_rows(u);
      const Column errors = model.weighted_errors(u);
      const Column newton = rows.colPivHouseholderQr().solve(errors);
      const Column g = rows.transpose() * errors;
      const Column cauchy = g * (g.squaredNorm() / (rows * g).squaredNorm());
      if (model.move(newton) < 1e-6L) break;
      Column du = newton;
      if (newton.norm() <= delta) {
        ++seen.newton;
      } else if (cauchy.norm() >= delta) {
        du = g.normalized() * delta;
        ++seen.gradient;
      } else {
        // Bisection on the second leg, along which the length grows.
        long double low = 0.0L;
        long double high = 1.0L;
        for (int half = 0; half < 80; ++half) {
          const long double middle = 0.5L * (low + high);
          ((cauchy + middle * (newton - cauchy)).norm() < delta ? low : high) = middle;
        }
        du = cauchy + low * (newton - cauchy);
        ++seen.second_leg;
      }
      const long double predicted = errors.squaredNorm() - (errors - rows * du).squaredNorm();
      const long double actual = errors.squaredNorm() - model.weighted_errors(u - du).squaredNorm();
      if (actual < 0.25L * predicted) {
        delta = 0.5L * std::min(delta, du.norm());
      } else if (actual > 0.75L * predicted) {
        delta = std::max(delta, 3.0L * du.norm());
      }
      if (actual >= 0.0L) {
        u -= du;
        ++seen.accepted;
      } else {
        ++seen.rejected;
      }
      check_step(sample, how, "dogleg", count, model.position(u));
    }
  });
  CAPTURE(seen.newton, seen.gradient, seen.second_leg, seen.rejected);
  CHECK(seen.newton > 50);
  CHECK(seen.gradient > 20);
  CHECK(seen.second_leg > 20);
  CHECK(seen.rejected > 5);
}
