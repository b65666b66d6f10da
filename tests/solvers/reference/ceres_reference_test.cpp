#include "solvers/reference/ceres_reference.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "tests/solvers/reference/reference_scene.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;
using solvers::ReferenceLoss;
using tests::make_scene;
using tests::Position;
using tests::Scene;

namespace {

constexpr double theta = 0.05;
constexpr auto both = {ReferenceLoss::WeightedSquares, ReferenceLoss::HuberTheta};

template <std::size_t N>
Eigen::Vector3d vector(const std::array<double, N>& x) {
  return {x[0], x[1], x[2]};
}

long double residual_of(const Scene& scene, std::size_t j, const Position& x) {
  long double squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const long double difference = static_cast<long double>(scene.batch.position(j, axis)[0]) - x[axis];
    squared += difference * difference;
  }
  return std::sqrt(squared) - scene.batch.measured(j)[0];
}

/// The objective, written from its definition; extended precision so that differences of it mean something.
long double objective(const Scene& scene, const Position& x, ReferenceLoss loss) {
  const bool huber = loss == ReferenceLoss::HuberTheta && scene.batch.points() > 3;
  long double sum = 0;
  for (std::size_t j = 0; j < scene.batch.points(); ++j) {
    const long double s = scene.batch.score(j)[0];
    const long double e = std::abs(residual_of(scene, j, x));
    if (loss == ReferenceLoss::WeightedSquares) {
      sum += s * s * e * e / 2;
    } else if (!huber) {
      sum += s * e * e / 2;
    } else {
      sum += s / theta * (e <= theta ? e * e / 2 : theta * (e - static_cast<long double>(theta) / 2));
    }
  }
  return sum;
}

/// Second derivatives of the objective by central differences of the gradient.
Eigen::Matrix3d hessian(const Scene& scene, const Position& x, ReferenceLoss loss) {
  constexpr double h = 1e-6;
  Eigen::Matrix3d result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Position up = x;
    Position down = x;
    up[axis] += h;
    down[axis] -= h;
    result.col(static_cast<Eigen::Index>(axis)) = (vector(solvers::gradient(scene.batch, 0, up, {loss, theta})) -
                                                   vector(solvers::gradient(scene.batch, 0, down, {loss, theta}))) /
                                                  (2 * h);
  }
  return result;
}

Eigen::Vector3d curvatures(const Scene& scene, const Position& x, ReferenceLoss loss) {
  const Eigen::Matrix3d h = hessian(scene, x, loss);
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>((h + h.transpose()) / 2).eigenvalues();
}

/// Compass search: goes to the best of the six neighbours at distance `step`, halving it when none is better.
Position compass_search(const Scene& scene, Position x, ReferenceLoss loss, double last_step) {
  long double value = objective(scene, x, loss);
  for (double step = 0.125; step >= last_step;) {
    Position best = x;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const double sign : {-1.0, 1.0}) {
        Position candidate = x;
        candidate[axis] += sign * step;
        const long double there = objective(scene, candidate, loss);
        if (there < value) {
          value = there;
          best = candidate;
        }
      }
    }
    if (best == x) step /= 2;
    x = best;
  }
  return x;
}

}  // namespace

TEST_CASE("without noise the truth is the minimiser", "[ceres_reference]") {
  for (const std::size_t points : {3u, 4u, 5u, 7u}) {
    for (const auto loss : both) {
      const Scene scene = make_scene(points, 0.0, points);
      CAPTURE(points, static_cast<int>(loss));
      // Near enough to the truth that no second minimum (3 points have a mirror image) is in the way.
      const Position near{scene.truth[0] + 0.1, scene.truth[1] - 0.1, scene.truth[2] + 0.1};
      const auto found = solvers::minimize(scene.batch, 0, near, {loss, theta});
      REQUIRE(found.converged);
      // The measured ranges are rounded, as the estimate is: gradients of twice the bound, divided by the
      // curvature.
      const double bound = solvers::gradient_rounding_bound(scene.batch, 0, scene.truth, {loss, theta});
      const double gap = (vector(found.estimate) - vector(scene.truth)).norm();
      CHECK(gap <= 2 * bound / curvatures(scene, scene.truth, loss)[0]);
    }
  }
}

TEST_CASE("the gradient is the derivative of the objective", "[ceres_reference]") {
  // Central differences err by h^2 / 6 times the third derivative, which for 1/2 w e^2 is at most
  // w (3 / r + 3 |e| / r^2), and by the rounding of the objective over h. Huber's loss adds nothing away from
  // its kink.
  constexpr double h = 1e-5;
  for (const std::size_t points : {3u, 5u, 7u}) {
    const Scene scene = make_scene(points, 0.1, 10 + points);
    for (const auto& x : {scene.truth, scene.start}) {
      for (const auto loss : both) {
        CAPTURE(points, static_cast<int>(loss), x[0]);
        double third = 0.0;
        for (std::size_t j = 0; j < points; ++j) {
          const double e = std::abs(static_cast<double>(residual_of(scene, j, x)));
          const double r = scene.batch.measured(j)[0] + static_cast<double>(residual_of(scene, j, x));
          REQUIRE(std::abs(e - theta) > h);
          third += (3 / r + 3 * e / (r * r)) / theta;
        }
        const double rounding =
            static_cast<double>(std::numeric_limits<long double>::epsilon() * objective(scene, x, loss)) *
            static_cast<double>(points) / h;
        const auto gradient = solvers::gradient(scene.batch, 0, x, {loss, theta});
        for (std::size_t axis = 0; axis < 3; ++axis) {
          Position up = x;
          Position down = x;
          up[axis] += h;
          down[axis] -= h;
          const auto difference = static_cast<double>((objective(scene, up, loss) - objective(scene, down, loss)) /
                                                      (static_cast<long double>(up[axis]) - down[axis]));
          CHECK(std::abs(gradient[axis] - difference) <= third * h * h / 6 + rounding);
        }
      }
    }
  }
}

TEST_CASE("the minimiser is the one that direct search finds", "[ceres_reference]") {
  // A compass search that stops at step h has |gradient| <= sqrt(3) L h (Kolda, Lewis and Torczon 2003), so
  // it is within sqrt(3) (L / l) h of the minimum, l and L the extreme curvatures. 2 leaves room for their
  // variation.
  constexpr double step = 0x1p-26;
  for (const std::size_t points : {3u, 4u, 5u, 6u, 7u}) {
    for (const auto loss : both) {
      const Scene scene = make_scene(points, 0.1, 20 + points);
      CAPTURE(points, static_cast<int>(loss));
      const auto found = solvers::minimize(scene.batch, 0, scene.truth, {loss, theta});
      REQUIRE(found.converged);
      const Position searched = compass_search(scene, scene.truth, loss, step);
      const Eigen::Vector3d curvature = curvatures(scene, found.estimate, loss);
      REQUIRE(curvature[0] > 0.0);
      const double gap = (vector(found.estimate) - vector(searched)).norm();
      CHECK(gap <= 2 * std::sqrt(3.0) * curvature[2] / curvature[0] * step);
      CHECK(found.cost ==
            Approx(static_cast<double>(objective(scene, found.estimate, loss))).epsilon(1e-12).margin(1e-25));
    }
  }
}

TEST_CASE("weights are Huber's only with more points than unknowns", "[ceres_reference]") {
  for (const std::size_t points : {3u, 4u, 5u}) {
    const Scene scene = make_scene(points, 0.5, 30 + points);
    const auto narrow = solvers::gradient(scene.batch, 0, scene.start, {ReferenceLoss::HuberTheta, 0.05});
    const auto wide = solvers::gradient(scene.batch, 0, scene.start, {ReferenceLoss::HuberTheta, 0.5});
    CAPTURE(points);
    CHECK((narrow == wide) == (points == 3));
  }
}

TEST_CASE("answers are stationary to rounding from ordinary starts", "[ceres_reference]") {
  for (std::uint64_t seed = 100; seed < 150; ++seed) {
    for (const std::size_t points : {3u, 4u, 5u, 7u}) {
      for (const auto loss : both) {
        const Scene scene = make_scene(points, 0.1, seed);
        CAPTURE(seed, points, static_cast<int>(loss));
        const auto found = solvers::minimize(scene.batch, 0, scene.start, {loss, theta});
        CHECK(found.converged);
        CHECK(found.iterations > 0);
        CHECK(found.gradient_norm <= solvers::gradient_rounding_bound(scene.batch, 0, found.estimate, {loss, theta}));
        CHECK(found.gradient_norm == vector(solvers::gradient(scene.batch, 0, found.estimate, {loss, theta})).norm());
      }
    }
  }
}
