// Options of rr and rrr, by hand and against a transcription with Eigen in long double.

#include <Eigen/Dense>
#include <cmath>
#include <random>

#include "tests/support/catch.hpp"
#include "tests/support/eigen_ridge.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

/// One step of rrr with all its options, K the paper's or constant.
Point robust_step(const Sample& sample, const solvers::SolverOptions& options) {
  const EigenModel model(sample, options);
  const Column u = model.start();
  const Column e = model.residual(u);
  const Matrix j = model.rows(u);
  const Column scores = model.score_weights().cwiseSqrt();

  Column least_squares_weights = scores;
  Column robust = scores;
  if (options.score_power != solvers::ScorePower::One) least_squares_weights = scores.cwiseProduct(scores);
  if (options.score_power == solvers::ScorePower::Two) robust = scores.cwiseProduct(scores);

  const auto gauss_newton = [&](const Column& at) {
    const Column root = least_squares_weights.cwiseSqrt();
    return least_squares(root.asDiagonal() * model.rows(at), root.asDiagonal() * model.residual(at));
  };
  Column step = gauss_newton(u);
  if (options.ols_mode == solvers::OlsMode::Full) {
    Column at = u;
    for (int i = 0; i < options.max_iterations; ++i) {
      const Column du = gauss_newton(at);
      at -= du;
      if (model.move(du) < options.step_tolerance_m) break;
    }
    step = u - at;
  }
  const bool many = options.irls_min_n > 0 ? model.points() >= options.irls_min_n : model.points() > model.unknowns();
  if (many) {
    const Column place = options.irls_residual == solvers::IrlsResidual::Ols ? Column(u - step) : u;
    const long double theta = options.theta_m;
    robust = robust.cwiseQuotient(model.residual(place).cwiseAbs().cwiseMax(theta));
  }
  if (options.normalize_weights == solvers::NormalizeWeights::On) robust /= robust.mean();

  const Column after = model.residual(u - step);
  const long double sigma2 =
      after.dot(least_squares_weights.cwiseProduct(after)) / static_cast<long double>(model.points());
  const Column root = least_squares_weights.cwiseSqrt();
  const Linearised problem{root.asDiagonal() * j, root.asDiagonal() * e, step};
  const auto name = solvers::k_estimator_registry()[options.k].name;
  const bool canonical = options.ridge_coordinates == solvers::RidgeCoordinates::Canonical;
  const Matrix k = ridge_matrix(name, problem, sigma2, canonical, options.k_fixed);
  const Column robust_root = robust.cwiseSqrt();
  return model.position(u - ridge_step(robust_root.asDiagonal() * j, robust_root.asDiagonal() * e, k));
}

/// Runs one step on many samples; `other` changes from the default what is tested.
template <class F>
void check_robust_step(F other) {
  std::mt19937_64 engine(51);
  int differs = 0;
  int compared = 0;
  for (int i = 0; i < 60; ++i) {
    const Sample sample = random_sample(engine, {.points = 5 + static_cast<std::size_t>(i % 3),
                                                 .images = i % 4 == 3,
                                                 .scores = true,
                                                 .sigma_m = 0.3,
                                                 .offset_m = 0.5});
    auto options = steps(1);
    options.k = k_index(i % 2 == 0 ? "fixed" : "kibria_gm");
    options.k_fixed = 0.3;
    const Point usual = estimate(solve("rrr", batch_of({sample}), options));
    other(options);
    const Point x = estimate(solve("rrr", batch_of({sample}), options));
    const Point expected = robust_step(sample, options);
    if (distance(expected, sample.start) > 10.0) continue;  // amplifies rounding as well
    CAPTURE(i);
    CHECK(distance(x, expected) < 1e-8);
    differs += distance(x, usual) > 1e-6 ? 1 : 0;
    ++compared;
  }
  CHECK(compared > 40);
  CHECK(differs > 15);
}

}  // namespace

TEST_CASE("rrr makes its weights of the residuals after the least-squares step") {
  check_robust_step([](solvers::SolverOptions& o) { o.irls_residual = solvers::IrlsResidual::Ols; });
}

TEST_CASE("rrr scales its weights to a mean of 1") {
  check_robust_step([](solvers::SolverOptions& o) { o.normalize_weights = solvers::NormalizeWeights::On; });
}

TEST_CASE("rrr has robust weights from irls_min_n points on") {
  check_robust_step([](solvers::SolverOptions& o) { o.irls_min_n = 6; });
  // Three points, three unknowns: w = 1 / 0.1, 1 / 0.2, 1 / 0.3 of J = -I, and 10 * 0.1 / (10 + 3) and so on.
  auto options = steps(1);
  options.k = k_index("fixed");
  options.k_fixed = 3.0;
  options.irls_min_n = 3;
  CHECK(distance(estimate(solve("rrr", axes_problem(0.1, -0.2, 0.3), options)),
                 {1.0 / 13.0, -1.0 / 8.0, 1.0 / (10.0 / 3.0 + 3.0)}) < 1e-15);
}

TEST_CASE("rrr takes scores to the power asked for") {
  check_robust_step([](solvers::SolverOptions& o) { o.score_power = solvers::ScorePower::Two; });
  check_robust_step([](solvers::SolverOptions& o) {
    o.score_power = solvers::ScorePower::One;
    o.k = k_index("kibria_gm");  // whose least squares has the power 1 too
    o.theta_m = 0.2;
  });
}

TEST_CASE("rrr learns K from a full least-squares solution") {
  check_robust_step([](solvers::SolverOptions& o) {
    o.ols_mode = solvers::OlsMode::Full;
    o.k = k_index("kibria_gm");
    o.max_iterations = 1;
  });
}

TEST_CASE("rrr adds K in canonical coordinates to the reweighted matrix") {
  check_robust_step([](solvers::SolverOptions& o) {
    o.ridge_coordinates = solvers::RidgeCoordinates::Canonical;
    o.k = k_index("kibria_am");
    o.irls_residual = solvers::IrlsResidual::Ols;
    o.normalize_weights = solvers::NormalizeWeights::On;
  });
}

TEST_CASE("the full least-squares solution is Gauss-Newton's") {
  // With K from the full solution, sigma2 = 0 where three ranges meet: rr's first step is then ols'.
  std::mt19937_64 engine(52);
  for (int i = 0; i < 20; ++i) {
    const Sample sample = random_sample(engine, {.points = 3, .sigma_m = 0.0, .offset_m = 0.5});
    solvers::SolverOptions options;
    options.step_tolerance_m = 1e-7;  // reached quadratically: residuals of 10^-13 m
    const auto ols = solve("ols", batch_of({sample}), options);
    if (status(ols) != core::Status::Converged || distance(estimate(ols), sample.truth) > 1e-9) continue;
    options.ols_mode = solvers::OlsMode::Full;
    options.k = k_index("hkb");
    const auto full = solve("rr", batch_of({sample}), options);
    CHECK(status(full) == core::Status::Converged);
    CHECK(full.iterations[0] == ols.iterations[0]);
    CHECK(distance(estimate(full), estimate(ols)) < 1e-9);
  }
}

TEST_CASE("a ridge towards the start leaves a bias: J'We + K (x - x_start) = 0 in the end") {
  std::mt19937_64 engine(53);
  for (int i = 0; i < 20; ++i) {
    const Sample sample = random_sample(engine, {.points = 6, .images = i % 2 == 1, .scores = true, .sigma_m = 0.3});
    solvers::SolverOptions options;
    options.k = k_index("fixed");
    options.k_fixed = 0.5;
    options.ridge_anchor = solvers::RidgeAnchor::Prior;
    options.step_tolerance_m = 1e-11;
    options.max_iterations = 1000;
    options.v_mode = solvers::VMode::Fixed;
    const auto s = solve("rr", batch_of({sample}), options);
    REQUIRE(status(s) == core::Status::Converged);
    const EigenModel model(sample, options);
    const EigenModel metres(sample, [&] {
      auto unscaled = options;
      unscaled.column_scale = solvers::ColumnScale::None;
      return unscaled;
    }());
    const Point x = estimate(s);
    const Column at = Eigen::Map<const Eigen::Vector3d>(x.data()).cast<long double>();
    // In the scaled unknowns u = |J_i| x_i, where K is formed.
    const Column u = at.cwiseProduct(model.start().cwiseQuotient(metres.start()));
    const Column gradient = model.weighted_rows(u).transpose() * model.weighted_errors(u);
    CHECK(static_cast<double>((gradient + 0.5L * (u - model.start())).norm()) < 1e-9);
    CHECK(static_cast<double>(gradient.norm()) > 1e-3);
    // Towards the iterate it leaves none.
    options.ridge_anchor = solvers::RidgeAnchor::Current;
    CHECK(solve("rr", batch_of({sample}), options).remaining_step_m[0] < 1e-8);
  }
}

TEST_CASE("the printed Jacobian diverges at once, the exact one does not") {
  std::mt19937_64 engine(54);
  for (int i = 0; i < 20; ++i) {
    const bool images = i % 2 == 1;
    const auto p = batch_of({random_sample(engine, {.points = 6, .images = images, .sigma_m = 0.05, .offset_m = 0.5})});
    CHECK(status(solve("ols", p, {})) == core::Status::Converged);
    solvers::SolverOptions options;
    options.jacobian = solvers::Jacobian::Printed;
    const auto s = solve("ols", p, options);
    CHECK(status(s) != core::Status::Converged);
    options.max_iterations = 3;
    const auto early = solve("ols", p, options);
    CHECK((status(early) == core::Status::LeftDomain || early.residual_rms_m[0] > 10.0));
  }
}

TEST_CASE("the quotient residual vanishes where the range residual does") {
  std::mt19937_64 engine(55);
  for (int i = 0; i < 20; ++i) {
    const Sample sample = random_sample(engine, {.points = 6, .images = true, .sigma_m = 0.0, .offset_m = 0.3});
    solvers::SolverOptions options;
    options.residual = solvers::Residual::Quotient;
    options.step_tolerance_m = 1e-10;
    options.max_iterations = 1000;
    const auto s = solve("ols", batch_of({sample}), options);
    CHECK(status(s) == core::Status::Converged);
    CHECK(distance(estimate(s), sample.truth) < 1e-6);
    CHECK(s.image_distance_mm[0] == Approx(sample.image_distance).epsilon(1e-6));
  }
}

TEST_CASE("scaling the columns does not change a Gauss-Newton step, but what K is") {
  std::mt19937_64 engine(56);
  for (int i = 0; i < 20; ++i) {
    const auto p = batch_of({random_sample(engine, {.points = 7, .images = true, .scores = true})});
    auto scaled = steps(1);
    auto unscaled = steps(1);
    unscaled.column_scale = solvers::ColumnScale::None;
    CHECK(distance(estimate(solve("ols", p, scaled)), estimate(solve("ols", p, unscaled))) < 1e-9);
    for (const char* k : {"kibria_gm", "fixed"}) {
      scaled.k = unscaled.k = k_index(k);
      scaled.k_fixed = unscaled.k_fixed = 0.5;
      CHECK(distance(estimate(solve("rr", p, scaled)), estimate(solve("rr", p, unscaled))) > 1e-6);
    }
  }
}
