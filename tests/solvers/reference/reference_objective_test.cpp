// The objectives of the reference: their losses against the weights of the solvers, their gradients against differences
// of the objective written from its definition.

#include "solvers/reference/reference_objective.hpp"

#include <cmath>
#include <functional>
#include <string>

#include "core/registry.hpp"
#include "solvers/methods/irls.hpp"
#include "solvers/methods/robust_weights.hpp"
#include "solvers/reference/ceres_reference.hpp"
#include "solvers/solver.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/pseudorange_scene.hpp"

using namespace ridgeloc;
using solvers::ReferenceLoss;
using solvers::ReferenceObjective;
using solvers::RobustLoss;

namespace {

/// The weight of the solver for u, with its floor and a lift.
double weight_of_solver(std::size_t index, double u, double tuning, double lift) {
  double w = 0.0;
  core::with_entry<solvers::RobustWeights>(index, [&](auto weight) { w = weight(u, tuning); });
  w = std::max(w, solvers::smallest_weight);
  return w + lift * (1.0 - w);
}

/// The objective of a trial of pseudoranges from its definition, in extended precision.
long double objective(const core::ProblemBatch& p, const std::array<long double, 4>& x, const ReferenceObjective& o) {
  long double sum = 0;
  const bool huber = o.loss == ReferenceLoss::HuberTheta;
  for (std::size_t j = 0; j < p.points(); ++j) {
    long double squared = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      squared += (p.position(j, axis)[0] - x[axis]) * (p.position(j, axis)[0] - x[axis]);
    const long double e = std::abs(std::sqrt(squared) - std::sqrt(p.alpha(j)[0] * x[3] * x[3] + p.measured(j)[0]));
    const long double s = p.score(j)[0];
    const long double theta = o.theta_m;
    if (huber) {
      sum += s / theta * (e <= theta ? e * e / 2 : theta * (e - theta / 2));
    } else {
      sum += (o.score_power == solvers::ScorePower::One ? s : s * s) * e * e / 2;
    }
  }
  if (o.v_mode == solvers::VMode::Prior) {
    const long double v = p.start_image_distance()[0];
    const long double deviations = (x[3] - v) / (0.005L * v);
    sum += (huber ? 1 / static_cast<long double>(o.theta_m) : 1) * o.sigma_prior_m * o.sigma_prior_m * deviations *
           deviations / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("losses of the reference have the weights of irls as derivatives", "[reference]") {
  REQUIRE(solvers::weight_registry().size() == 5);
  for (std::size_t index = 0; index < solvers::weight_registry().size(); ++index) {
    const auto shape = solvers::find_loss_shape(solvers::weight_registry()[index].name);
    REQUIRE(shape);
    core::with_entry<solvers::RobustWeights>(
        index, [&](auto weight) { CHECK(solvers::standard_tuning(*shape) == weight.tuning); });
    for (const double lift : {0.0, 0.4, 1.0}) {
      for (const double tuning : {solvers::standard_tuning(*shape), 0.7}) {
        const RobustLoss loss{*shape, tuning, 0.2, solvers::smallest_weight, lift};
        CHECK(loss(0.0)[0] == 0.0);
        CHECK(loss(0.0)[1] == 1.0);
        for (double u = 0.01; u < 300.0; u *= 1.01) {
          CAPTURE(solvers::weight_registry()[index].name, lift, tuning, u);
          const double squared = 0.04 * u * u;
          const auto [value, first, second] = loss(squared);
          CHECK(first == Approx(weight_of_solver(index, u, tuning, lift)).epsilon(1e-12));
          // Central differences over +- 1e-4 s: off by 1e-8 / 6 times s^2 and the third derivative (at most 8 here), by
          // rounding of 1e-12, and at a kink by as much as the second derivative jumps there.
          const double h = 1e-4 * squared;
          const auto below = loss(squared - h);
          const auto above = loss(squared + h);
          const double jump = std::fabs(above[2] - below[2]);
          CHECK(std::fabs(first - (above[0] - below[0]) / (2.0 * h)) <= 1e-7 + h * jump);
          CHECK(squared * std::fabs(second - (above[1] - below[1]) / (2.0 * h)) <= 1e-6 + squared * jump);
        }
      }
    }
  }
}

TEST_CASE("gradients of pseudoranges are the derivatives of the objective", "[reference]") {
  // Differences over 2 h = 2e-5 of lengths and 2e-6 of v: third derivatives are of the order of the weights (at most
  // 20) over the range, h^2 / 6 of them below 1e-8; by v column norms of 4 per mm raise that to below 1e-7.
  const core::ProblemBatch p = tests::pseudorange_scenes(6, 1, 0.1, 5);
  const std::array<double, 3> place{p.start(0)[0] + 0.3, p.start(1)[0] - 0.2, p.start(2)[0] + 0.1};
  const double v = p.start_image_distance()[0] * 1.01;
  for (const auto loss : {ReferenceLoss::WeightedSquares, ReferenceLoss::HuberTheta}) {
    for (const auto v_mode : {solvers::VMode::Free, solvers::VMode::Fixed, solvers::VMode::Prior}) {
      for (const auto z_mode : {solvers::ZMode::Free, solvers::ZMode::Fixed}) {
        ReferenceObjective o{loss};
        o.score_power = loss == ReferenceLoss::WeightedSquares ? solvers::ScorePower::One : o.score_power;
        o.v_mode = v_mode;
        o.z_mode = z_mode;
        CAPTURE(static_cast<int>(loss), static_cast<int>(v_mode), static_cast<int>(z_mode));
        const auto gradient = solvers::gradient(p, 0, {place, v}, o);
        const bool v_known = v_mode == solvers::VMode::Fixed;
        const bool z_known = z_mode == solvers::ZMode::Fixed;
        for (std::size_t i = 0; i < 4; ++i) {
          if ((i == 2 && z_known) || (i == 3 && v_known)) {
            CHECK(gradient[i] == 0.0);
            continue;
          }
          const double h = i == 3 ? 1e-6 : 1e-5;
          std::array<long double, 4> up{place[0], place[1], z_known ? p.start(2)[0] : place[2],
                                        v_known ? p.start_image_distance()[0] : v};
          std::array<long double, 4> down = up;
          up[i] += h;
          down[i] -= h;
          const auto difference =
              static_cast<double>((objective(p, up, o) - objective(p, down, o)) / (up[i] - down[i]));
          CHECK(std::fabs(gradient[i] - difference) <= (i == 3 ? 1e-7 : 1e-8));
        }
      }
    }
  }
}

TEST_CASE("a prior on v draws the minimiser to the start as its weight says", "[reference]") {
  // One unknown is left by hand: with v alone wrong, and sigma -> 0, the prior weighs nothing and v is that of the
  // data; with sigma large v stays at the start.
  const core::ProblemBatch p = tests::pseudorange_scenes(7, 1, 0.0, 6);
  ReferenceObjective o;
  o.v_mode = solvers::VMode::Prior;
  const std::array<double, 3> truth = tests::pseudorange_truth();
  o.sigma_prior_m = 1e-9;
  const auto loose = solvers::minimize(p, 0, {truth, tests::true_distance_mm}, o);
  REQUIRE(loose.converged);
  CHECK(std::fabs(loose.image_distance_mm - tests::true_distance_mm) < 1e-9);
  o.sigma_prior_m = 1e6;
  const auto tight = solvers::minimize(p, 0, {truth, tests::true_distance_mm}, o);
  REQUIRE(tight.converged);
  CHECK(std::fabs(tight.image_distance_mm - p.start_image_distance()[0]) < 1e-9);
}

TEST_CASE("the scale and the lift are those of irls at the estimate", "[reference]") {
  // Residuals at the origin: 0.1, -0.2, 0.4, 0.3 and -5: median of sizes 0.3, scale 0.44478.
  core::ProblemBatch p;
  p.reshape(5, 1);
  const double errors[] = {0.1, -0.2, 0.4, 0.3, -5.0};
  for (std::size_t j = 0; j < 5; ++j) {
    for (std::size_t axis = 0; axis < 3; ++axis) p.position(j, axis)[0] = j % 3 == axis ? (j < 3 ? 10.0 : -10.0) : 0.0;
    p.measured(j)[0] = 10.0 - errors[j];
  }
  for (std::size_t axis = 0; axis < 3; ++axis) p.start(axis)[0] = 0.0;
  solvers::SolverOptions options;
  options.tuning = 0.5;
  auto o = *solvers::reference_objective(solvers::solver_named("irls"), options);
  CHECK(o.robust.shape == solvers::LossShape::Huber);
  auto frozen = solvers::at_estimate(o, p, 0, std::array<double, 3>{0, 0, 0});
  const double scale = 1.4826 * 0.3;
  CHECK(frozen.robust.scale_m == Approx(scale).epsilon(1e-14));
  // Weights 1, 1, and 0.5 scale / |e| for 0.4, 0.3 and 5: their sum c = 2 + 0.22239 (2.5 + 10 / 3 + 0.2) > 3, no lift.
  CHECK(frozen.robust.lift == 0.0);
  options.tuning = 0.1;
  o = *solvers::reference_objective(solvers::solver_named("irls"), options);
  frozen = solvers::at_estimate(o, p, 0, std::array<double, 3>{0, 0, 0});
  // 0.044478 (10 + 5 + 2.5 + 10 / 3), and 0.01 for the last, whose own would be less.
  const double c = 0.1 * scale * (10.0 + 5.0 + 2.5 + 10.0 / 3.0) + 0.01;
  CHECK(frozen.robust.lift == Approx((3.0 - c) / (5.0 - c)).epsilon(1e-13));
  options.scale = solvers::Scale::Fixed;
  options.scale_m = 0.25;
  o = *solvers::reference_objective(solvers::solver_named("irls"), options);
  CHECK(solvers::at_estimate(o, p, 0, std::array<double, 3>{0, 0, 0}).robust.scale_m == 0.25);
}

TEST_CASE("what minimises nothing has no reference", "[reference]") {
  const auto has = [](const char* solver, const std::function<void(solvers::SolverOptions&)>& change) {
    solvers::SolverOptions options;
    change(options);
    return solvers::reference_objective(solvers::solver_named(solver), options).has_value();
  };
  const auto nothing = [](solvers::SolverOptions&) {};
  for (const char* solver : {"ols", "lm", "dogleg", "rr", "rrr", "irls", "gn_prior"}) {
    CAPTURE(solver);
    CHECK(has(solver, nothing));
    CHECK_FALSE(has(solver, [](auto& o) { o.jacobian = solvers::Jacobian::Printed; }));
    CHECK_FALSE(has(solver, [](auto& o) { o.residual = solvers::Residual::Quotient; }));
    const bool ridge = std::string(solver).starts_with("rr");
    CHECK(has(solver, [](auto& o) { o.ridge_anchor = solvers::RidgeAnchor::Prior; }) == !ridge);
    // Neither the scale of the columns nor that of the weights moves a minimiser.
    CHECK(has(solver, [](auto& o) { o.column_scale = solvers::ColumnScale::None; }));
    CHECK(has(solver, [](auto& o) { o.normalize_weights = solvers::NormalizeWeights::On; }));
  }
  CHECK_FALSE(has("linear", nothing));
  CHECK_FALSE(has("bancroft", nothing));
  CHECK_FALSE(has("rrr", [](auto& o) {
    o.normalize_weights = solvers::NormalizeWeights::On;
    o.v_mode = solvers::VMode::Prior;
  }));
  solvers::SolverOptions options;
  CHECK(solvers::reference_objective(solvers::solver_named("rrr"), options)->binding);
  options.irls_residual = solvers::IrlsResidual::Ols;
  CHECK_FALSE(solvers::reference_objective(solvers::solver_named("rrr"), options)->binding);
  CHECK(solvers::reference_objective(solvers::solver_named("gn_prior"), options)->v_mode == solvers::VMode::Prior);
}
