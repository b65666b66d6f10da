// irls: weights by their formulas, and one step against an independent computation.

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <string_view>

#include "solvers/methods/robust_weights.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eigen_model.hpp"
#include "tests/support/eigen_ridge.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

long double weight(std::string_view name, long double u) {
  if (name == "huber") return std::min(1.0L, 1.345L / u);
  if (name == "tukey") return u < 4.685L ? std::pow(1.0L - std::pow(u / 4.685L, 2.0L), 2.0L) : 0.0L;
  if (name == "cauchy") return 1.0L / (1.0L + std::pow(u / 2.385L, 2.0L));
  if (name == "geman_mcclure") return 1.0L / std::pow(1.0L + u * u, 2.0L);
  REQUIRE(name == "igg3");
  if (u <= 1.5L) return 1.0L;
  return u < 3.0L ? 1.5L / u * std::pow((3.0L - u) / 1.5L, 2.0L) : 0.0L;
}

struct Seen {
  int floored = 0;
  int lifted = 0;
};

/// Weights of the observations without their scores.
Column weights(const Column& residual, std::string_view name, long double scale, long unknowns, Seen& seen) {
  Column w(residual.size());
  for (long j = 0; j < w.size(); ++j) {
    w(j) = weight(name, std::abs(residual(j)) / scale);
    seen.floored += w(j) < 0.01L ? 1 : 0;
    w(j) = std::max(w(j), 0.01L);
  }
  const auto n = static_cast<long double>(w.size());
  const auto p = static_cast<long double>(unknowns);
  if (w.sum() < p) {
    const long double lift = (p - w.sum()) / (n - w.sum());
    w += lift * (Column::Ones(w.size()) - w);
    ++seen.lifted;
  }
  return w;
}

long double median_size(const Column& residual) {
  Column sizes = residual.cwiseAbs();
  std::sort(sizes.begin(), sizes.end());
  const long n = sizes.size();
  return n % 2 == 1 ? sizes(n / 2) : 0.5L * (sizes(n / 2 - 1) + sizes(n / 2));
}

}  // namespace

TEST_CASE("weights at chosen residuals") {
  const auto at = [](auto of, double u) { return of(u, decltype(of)::tuning); };
  CHECK(at(solvers::HuberWeight{}, 1.345) == 1.0);
  CHECK(at(solvers::HuberWeight{}, 2.69) == Approx(0.5));
  CHECK(at(solvers::TukeyWeight{}, 4.685 / 2.0) == Approx(0.5625));
  CHECK(at(solvers::TukeyWeight{}, 4.7) == 0.0);
  CHECK(at(solvers::CauchyWeight{}, 2.385) == Approx(0.5));
  CHECK(at(solvers::GemanMcClureWeight{}, 1.0) == Approx(0.25));
  CHECK(at(solvers::Igg3Weight{}, 1.5) == 1.0);
  CHECK(at(solvers::Igg3Weight{}, 2.25) == Approx(1.0 / 6.0));  // (1.5 / 2.25) (0.75 / 1.5)^2
  CHECK(at(solvers::Igg3Weight{}, 3.1) == 0.0);
  CHECK(solvers::HuberWeight{}(2.0, 1.0) == 0.5);
}

TEST_CASE("a step of irls is weighted least squares with weights by the median residual or a fixed scale") {
  std::mt19937_64 engine(31);
  Seen seen;
  for (std::size_t w = 0; w < solvers::weight_registry().size(); ++w) {
    const auto name = solvers::weight_registry()[w].name;
    for (int i = 0; i < 60; ++i) {
      auto options = steps(1);
      options.weight = w;
      options.scale = i % 4 == 3 ? solvers::Scale::Fixed : solvers::Scale::Mad;
      options.scale_m = 0.2;
      Sample sample = random_sample(engine, {.points = 4 + static_cast<std::size_t>(i % 6),
                                             .images = i % 3 == 2,
                                             .scores = i % 2 == 0,
                                             .sigma_m = 0.3,
                                             .offset_m = 0.3});
      sample.measured[0] += sample.has_images() ? 20.0 : 4.0;  // an outlier
      const EigenModel model(sample, options);
      if (model.points() < model.unknowns()) continue;
      const Column u = model.start();
      const Column e = model.residual(u);
      const long double scale = options.scale == solvers::Scale::Fixed ? 0.2L : 1.4826L * median_size(e);
      const Column root = weights(e, name, scale, model.unknowns(), seen).cwiseSqrt();
      const Matrix rows = root.asDiagonal() * model.weighted_rows(u);
      const Column du = least_squares(rows, root.asDiagonal() * model.weighted_errors(u));
      const double bound = 1e-13 * condition(rows) * (1.0 + static_cast<double>(model.move(du)));
      CAPTURE(name, i);
      CHECK(distance(estimate(solve("irls", batch_of({sample}), options)), model.position(u - du)) < bound);
    }
  }
  CHECK(seen.floored > 20);
  CHECK(seen.lifted > 20);
}

TEST_CASE("irls with no more points than unknowns is ols") {
  std::mt19937_64 engine(32);
  for (std::size_t w = 0; w < solvers::weight_registry().size(); ++w) {
    auto options = steps(3);
    options.weight = w;
    for (int i = 0; i < 10; ++i) {
      const auto three = batch_of({random_sample(engine, {.points = 3, .scores = true})});
      CHECK(distance(estimate(solve("irls", three, options)), estimate(solve("ols", three, options))) < 1e-9);
      // Three pseudoranges, four unknowns: singular, not a number less.
      const auto few = batch_of({random_sample(engine, {.points = 3, .images = true})});
      CHECK(status(solve("irls", few, options)) == status(solve("ols", few, options)));
      CHECK(estimate(solve("irls", few, steps(1))) == estimate(solve("ols", few, steps(1))));
    }
  }
}

TEST_CASE("irls finds the position among exact ranges and one gross error") {
  std::mt19937_64 engine(33);
  for (const auto& entry : solvers::weight_registry()) {
    if (entry.name == "huber" || entry.name == "cauchy") continue;  // these do not reject
    solvers::SolverOptions options;
    options.weight = static_cast<std::size_t>(&entry - solvers::weight_registry().data());
    options.step_tolerance_m = 1e-9;
    options.max_iterations = 200;
    Sample sample = random_sample(engine, {.points = 8, .sigma_m = 0.0, .offset_m = 0.1});
    sample.measured[3] += 5.0;
    // Nothing is left of the scale but its floor, and of the outlier 1 % of its weight.
    const Point ols = estimate(solve("ols", batch_of({sample}), options));
    const Point robust = estimate(solve("irls", batch_of({sample}), options));
    INFO(entry.name);
    CHECK(distance(robust, sample.truth) < 0.1 * distance(ols, sample.truth));
  }
}
