// One step of each solver against values worked out by hand.

#include "tests/support/catch.hpp"
#include "tests/support/hand_scene.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

TEST_CASE("ols takes the Gauss-Newton step") {
  // J = -I, e = (0.1, -0.2, 0.3): dx = J'e = (-0.1, 0.2, -0.3), x = -dx.
  const auto s = solve("ols", axes_problem(0.1, -0.2, 0.3), steps(1));
  CHECK(distance(estimate(s), {0.1, -0.2, 0.3}) < 1e-15);
  CHECK(status(s) == core::Status::IterationLimit);
  CHECK(s.iterations[0] == 1.0);
}

TEST_CASE("ols weighs with the squared score") {
  // A fourth point opposite the first sees the same x: 1 * 0.1 against 0.5^2 * (-0.3) over 1 + 0.25.
  auto p = problem({{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {-2, 0, 0}}, {1.9, 2, 2, 2.3}, {0, 0, 0});
  p.add_scores();
  for (const std::size_t j : {0, 1, 2}) p.score(j)[0] = 1.0;
  p.score(3)[0] = 0.5;
  const auto s = solve("ols", p, steps(1));
  // g_x = 1 * 0.1 * (-1) + 0.25 * (-0.3) * 1 = -0.175; x = 0.175 / 1.25.
  CHECK(estimate(s)[0] == Approx(0.14).epsilon(1e-14));
}

TEST_CASE("rr divides by 1 + k where J'J is the identity") {
  auto options = steps(1);
  options.k = k_index("fixed");
  options.k_fixed = 3.0;
  CHECK(distance(estimate(solve("rr", axes_problem(0.1, -0.2, 0.3), options)), {0.025, -0.05, 0.075}) < 1e-15);
}

TEST_CASE("kibria_gm is sigma2 over the geometric mean of the squared step") {
  const auto options = steps(1);
  const auto s = solve("rr", axes_problem(0.1, -0.2, 0.3), options);
  // e_ls at (0.1, -0.2, 0.3): distances to the points minus the measured ranges.
  const Point x{0.1, -0.2, 0.3};
  const double e[3] = {distance(x, {2, 0, 0}) - 1.9, distance(x, {0, 2, 0}) - 2.2, distance(x, {0, 0, 2}) - 1.7};
  const double sigma2 = (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) / 3.0;
  const double k = sigma2 / std::cbrt(0.01 * 0.04 * 0.09);
  CHECK(distance(estimate(s), {0.1 / (1 + k), -0.2 / (1 + k), 0.3 / (1 + k)}) < 1e-15);
}

TEST_CASE("kibria_gm floors a component of zero length at a nanometre") {
  const auto s = solve("rr", axes_problem(0.1, -0.2, 0.0), steps(1));
  const Point x{0.1, -0.2, 0.0};
  const double e[3] = {distance(x, {2, 0, 0}) - 1.9, distance(x, {0, 2, 0}) - 2.2, distance(x, {0, 0, 2}) - 2.0};
  const double sigma2 = (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) / 3.0;
  const double k = sigma2 / std::cbrt(0.01 * 0.04 * 1e-18);
  CHECK(estimate(s)[0] == Approx(0.1 / (1 + k)).epsilon(1e-12));
}

TEST_CASE("rrr weighs residuals by 1 / max(theta, |e|) where there are more points than unknowns") {
  const auto p = problem({{2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {-2, 0, 0}}, {1.9, 2.1, 1.99, 2.5}, {0, 0, 0});
  auto options = steps(1);
  options.k = k_index("fixed");
  options.k_fixed = 2.0;
  const auto s = solve("rrr", p, options);
  // e = (0.1, -0.1, 0.01, -0.5), w = (10, 10, 20, 2):
  // x: (10 * 0.1 + 2 * 0.5) / (10 + 2 + 2), y: -(10 * 0.1) / 12, z: (20 * 0.01) / 22.
  CHECK(distance(estimate(s), {2.0 / 14.0, -1.0 / 12.0, 0.2 / 22.0}) < 1e-15);
}

TEST_CASE("rrr has no residual weights where points are as many as unknowns") {
  auto options = steps(1);
  options.k = k_index("fixed");
  options.k_fixed = 3.0;
  auto p = axes_problem(0.1, -0.2, 0.3);
  p.add_scores();
  for (const std::size_t j : {0, 1, 2}) p.score(j)[0] = 0.5;
  // w = s = 0.5: 0.5 e / (0.5 + 3).
  CHECK(distance(estimate(solve("rrr", p, options)), {0.05 / 3.5, -0.1 / 3.5, 0.15 / 3.5}) < 1e-15);
}

TEST_CASE("lm is Gauss-Newton as long as the residual falls") {
  const auto p = axes_problem(0.1, -0.2, 0.3);
  for (const int count : {1, 2, 3})
    CHECK(estimate(solve("lm", p, steps(count))) == estimate(solve("ols", p, steps(count))));
}

TEST_CASE("lm rejects a step that raises the residual and damps the next ones") {
  const std::vector<Point> points = {{6, -1.5, 2}, {3.5, 1, 0}, {3, 2, 0}};
  const std::vector<double> measured = {6.7, 3.4, 3.7};
  const Point start{2.5, 1.5, -3.5};
  const auto p = problem(points, measured, start);
  const auto cost = [&](const Point& x) {
    double sum = 0.0;
    for (std::size_t j = 0; j < 3; ++j) sum += std::pow(distance(x, points[j]) - measured[j], 2);
    return sum;
  };
  REQUIRE(cost(estimate(solve("ols", p, steps(1)))) > cost(start));
  const auto first = solve("lm", p, steps(1));
  CHECK(estimate(first) == start);
  CHECK(first.iterations[0] == 1.0);

  // A rejected step never meets the stop rule, however short: with a tolerance of a kilometre the first accepted one
  // does.
  solvers::SolverOptions loose;
  loose.step_tolerance_m = 1000.0;
  const auto stopped = solve("lm", p, loose);
  CHECK(status(stopped) == core::Status::Converged);
  CHECK(stopped.iterations[0] > 1.0);
  double before = cost(start);
  for (int count = 1; count <= 12; ++count) {
    const double now = cost(estimate(solve("lm", p, steps(count))));
    CHECK(now <= before);
    before = now;
  }
}
