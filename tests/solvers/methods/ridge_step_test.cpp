// One step of rr with every estimator of K against an independent computation with Eigen in long double.

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "solvers/estimators/k_kernels.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/eigen_ridge.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

struct Case {
  const char* name;
  bool images;
  solvers::ZMode z_mode;
  solvers::VMode v_mode;
};
const Case cases[] = {
    {"ranges", false, solvers::ZMode::Free, solvers::VMode::Free},
    {"ranges of known height", false, solvers::ZMode::Fixed, solvers::VMode::Free},
    {"x, y", true, solvers::ZMode::Fixed, solvers::VMode::Fixed},
    {"x, y, v", true, solvers::ZMode::Fixed, solvers::VMode::Free},
    {"x, y, z", true, solvers::ZMode::Free, solvers::VMode::Fixed},
    {"x, y, z, v", true, solvers::ZMode::Free, solvers::VMode::Free},
    {"x, y, z, v with a prior", true, solvers::ZMode::Free, solvers::VMode::Prior},
};

std::vector<Sample> samples(const Case& of, std::uint64_t seed, std::size_t count, std::size_t points) {
  std::mt19937_64 engine(seed);
  std::vector<Sample> all;
  for (std::size_t i = 0; i < count; ++i) {
    all.push_back(random_sample(engine, {.points = points, .images = of.images, .scores = true}));
  }
  return all;
}

bool learns_by_formula(const solvers::KEstimatorEntry& entry) {
  return !entry.needs_oracle && entry.name != "gcv" && entry.name != "expr";  // a user's own
}

struct Deviation {
  double largest_ratio = 0.0;  ///< of the gap over its bound
  std::size_t compared = 0;
  std::size_t wrong_status = 0;
};

Deviation compare(const std::vector<Sample>& all, std::string_view k, const solvers::SolverOptions& options) {
  Deviation d;
  const auto solutions = solve("rr", batch_of(all), options);
  for (std::size_t t = 0; t < all.size(); ++t) {
    const EigenModel model(all[t], options);
    const Column u = model.start();
    Linearised problem{model.weighted_rows(u), model.weighted_errors(u), {}};
    problem.step = least_squares(problem.rows, problem.errors);
    const Column left = problem.errors - problem.rows * problem.step;
    long double sigma2 = options.sigma_prior_m * static_cast<long double>(options.sigma_prior_m);
    double cancellation = 1.0;
    if (options.sigma2_source == solvers::Sigma2Source::NonlinearMs) {
      // A prior is one of the observations here as it is among the degrees of freedom.
      sigma2 = model.weighted_errors(u - problem.step).squaredNorm() / static_cast<long double>(left.size());
    } else if (options.sigma2_source == solvers::Sigma2Source::Dof) {
      sigma2 = left.squaredNorm() / static_cast<long double>(left.size() - model.unknowns());
      cancellation = static_cast<double>(problem.errors.squaredNorm() / left.squaredNorm());
    }
    const bool canonical = options.ridge_coordinates == solvers::RidgeCoordinates::Canonical;
    const Matrix ridge = ridge_matrix(k, problem, sigma2, canonical, options.k_fixed);
    const Column du = ridge_step(problem.rows, problem.errors, ridge);
    const Point expected = model.position(u - du);

    // Rounding: dx_ls errs by cond eps |dx_ls|, which is that much more of its smallest component alpha_i, and so do
    // k ~ 1 / alpha_i^2 and the step; eigenvectors by eps l_max / gap, where a gap below 1e-3 l_max is left out; the
    // residual sum of squares by eps e'We. 1000 covers the operations.
    const Eigen::SelfAdjointEigenSolver<Matrix> eigen(Matrix(problem.rows.transpose() * problem.rows));
    const Column l = eigen.eigenvalues();
    double gap = 1.0;
    for (long i = 1; i < l.size(); ++i) gap = std::min(gap, static_cast<double>((l(i) - l(i - 1)) / l(l.size() - 1)));
    if (gap < 1e-3) continue;
    // Far above the eigenvalues, a k along an eigenvector that is no axis fails the test for singularity, a bound by
    // rows.
    if (canonical && k == "hk" && ridge.norm() > 1e3L * l(l.size() - 1)) continue;
    const Column alpha =
        canonical || k == "khalaf_shukur" ? Column(eigen.eigenvectors().transpose() * problem.step) : problem.step;
    const double shortness = static_cast<double>(problem.step.norm() / alpha.cwiseAbs().minCoeff());
    const double bound = 1000.0 * std::numeric_limits<double>::epsilon() *
                         (condition(problem.rows) * shortness / gap + cancellation) *
                         (1.0 + static_cast<double>(model.move(problem.step)));
    d.largest_ratio = std::max(d.largest_ratio, distance(estimate(solutions, t), expected) / bound);
    d.wrong_status += status(solutions, t) == core::Status::IterationLimit ? 0 : 1;
    ++d.compared;
  }
  return d;
}

template <class F>
void for_each_choice(F f) {
  for (const auto& entry : solvers::k_estimator_registry()) {
    if (!learns_by_formula(entry)) continue;
    for (const auto source :
         {solvers::Sigma2Source::NonlinearMs, solvers::Sigma2Source::Dof, solvers::Sigma2Source::Prior}) {
      for (const auto coordinates : {solvers::RidgeCoordinates::Raw, solvers::RidgeCoordinates::Canonical}) {
        auto options = steps(1);
        options.k = k_index(std::string(entry.name).c_str());
        options.k_fixed = 0.3;
        options.sigma2_source = source;
        options.ridge_coordinates = coordinates;
        f(entry.name, options);
      }
    }
  }
}

}  // namespace

TEST_CASE("a step of rr is what Eigen makes of the definitions of K, sigma2 and the models") {
  for (const Case& of : cases) {
    for (const std::size_t points : {5, 8}) {
      const auto all = samples(of, 17 * points, 100, points);
      for_each_choice([&](std::string_view k, solvers::SolverOptions options) {
        options.z_mode = of.z_mode;
        options.v_mode = of.v_mode;
        INFO(of.name << ", " << points << " points, k " << k << ", sigma2 " << static_cast<int>(options.sigma2_source)
                     << ", coordinates " << static_cast<int>(options.ridge_coordinates));
        const Deviation d = compare(all, k, options);
        CHECK(d.largest_ratio <= 1.0);
        CHECK(d.compared > 60);
        CHECK(d.wrong_status == 0);
      });
    }
  }
}

namespace {

/// The scene with its axes turned by a rotation or a permutation.
Sample turned(Sample sample, const Eigen::Matrix3d& by) {
  const auto turn = [&](Point& p) {
    Eigen::Map<Eigen::Vector3d>(p.data()) = by * Eigen::Map<Eigen::Vector3d>(p.data());
  };
  for (Point& p : sample.points) turn(p);
  turn(sample.start);
  turn(sample.truth);
  return sample;
}

/// The share of scenes whose step turns with them, to rounding.
double share_turning(const std::vector<Sample>& all, const Eigen::Matrix3d& by, const solvers::SolverOptions& options) {
  std::vector<Sample> others;
  for (const Sample& sample : all) others.push_back(turned(sample, by));
  const auto before = solve("rr", batch_of(all), options);
  const auto after = solve("rr", batch_of(others), options);
  std::size_t same = 0;
  for (std::size_t t = 0; t < all.size(); ++t) {
    const Point x = estimate(before, t);
    const Eigen::Vector3d expected = by * Eigen::Map<const Eigen::Vector3d>(x.data());
    // 1e-7 m: cond <= 1e4 times shortness <= 1e3 times some hundred eps for all but a few scenes of a hundred.
    same += distance(estimate(after, t), {expected(0), expected(1), expected(2)}) < 1e-7 ? 1 : 0;
  }
  return static_cast<double>(same) / static_cast<double>(all.size());
}

}  // namespace

TEST_CASE("the order of the unknowns does not matter, and canonical coordinates turn with the scene") {
  const auto all = samples(cases[0], 5, 200, 6);
  Eigen::Matrix3d permutation;
  permutation << 0, 0, 1, 1, 0, 0, 0, 1, 0;
  const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(0.9, Eigen::Vector3d(1.0, 2.0, -1.0).normalized()).toRotationMatrix();
  for_each_choice([&](std::string_view k, const solvers::SolverOptions& options) {
    INFO("k " << k << ", sigma2 " << static_cast<int>(options.sigma2_source) << ", coordinates "
              << static_cast<int>(options.ridge_coordinates));
    CHECK(share_turning(all, permutation, options) >= 0.98);
    const bool canonical = options.ridge_coordinates == solvers::RidgeCoordinates::Canonical;
    if (canonical) CHECK(share_turning(all, rotation, options) >= 0.98);
    if (!canonical && (k == "hk" || k == "kibria_gm")) CHECK(share_turning(all, rotation, options) < 0.5);
  });
}

namespace {

/// gcv's k from a context, and the score that it has, over the least score of a fine grid.
template <std::size_t P>
double score_ratio(const EigenModel& model, const solvers::SolverOptions& options) {
  const Column u = model.start();
  const Eigen::MatrixXd rows = model.weighted_rows(u).cast<double>();
  const Eigen::VectorXd errors = model.weighted_errors(u).cast<double>();
  const Eigen::MatrixXd normal = rows.transpose() * rows;
  solvers::KContext<double, P> c{{}, {}, errors.squaredNorm(), 0.01, {}, {}, {}, 0.0, {}, nullptr, options};
  c.observations = static_cast<std::size_t>(rows.rows());
  const Eigen::VectorXd step = normal.ldlt().solve(rows.transpose() * errors);
  for (std::size_t i = 0; i < P; ++i) {
    c.ols_step[i] = step(static_cast<long>(i));
    for (std::size_t j = i; j < P; ++j)
      c.least_squares.matrix(i, j) = normal(static_cast<long>(i), static_cast<long>(j));
  }
  solvers::RidgeMatrix<double, P> out;
  solvers::k_kernel<double, P>(k_index("gcv"))(c, out);
  const double l_max = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(normal).eigenvalues().maxCoeff();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 1200; ++i)
    least = std::min(least, gcv_score(rows, errors, l_max * std::pow(10.0, -8.0 + 0.01 * i)));
  return gcv_score(rows, errors, out(0, 0)) / least;
}

}  // namespace

TEST_CASE("gcv has the least score of all k, by a brute-force search over the matrix formula") {
  // A fine grid of 0.01 decades misses the minimum by little; golden section is closer still, unless it went to the
  // wrong one of two minima.
  for (const std::size_t points : {5, 8}) {
    for (const Case& of : cases) {
      solvers::SolverOptions options;
      options.z_mode = of.z_mode;
      options.v_mode = of.v_mode;
      double worst = 0.0;
      for (const Sample& sample : samples(of, 3, 20, points)) {
        const EigenModel model(sample, options);
        const double ratio = model.unknowns() == 2   ? score_ratio<2>(model, options)
                             : model.unknowns() == 3 ? score_ratio<3>(model, options)
                                                     : score_ratio<4>(model, options);
        worst = std::max(worst, ratio);
      }
      INFO(of.name << ", " << points << " points");
      CHECK(worst <= 1.0 + 1e-7);
    }
  }
}
