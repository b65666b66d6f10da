// lm with lm_variant = more against MINPACK's lmder and lmpar, written out anew with QR factorizations in long double.

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/eigen_model.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

/// lmder, one pass of its inner loop at a time, in the names of MINPACK.
class Lmder {
 public:
  explicit Lmder(const EigenModel& model) : model_(model), x_(model.start()) {}

  const Column& x() const { return x_; }
  int damped() const { return damped_; }
  long double predicted() const { return predicted_; }
  long double length() const { return length_; }  ///< of the last step

  /// Whether the step was accepted.
  bool pass() {
    const Matrix fjac = model_.weighted_rows(x_);
    const Column fvec = model_.weighted_errors(x_);
    const long double fnorm = fvec.norm();
    const Column norms = fjac.colwise().norm().transpose();
    if (delta_ < 0.0L) {
      diag_ = norms;
      delta_ = 100.0L * diag_.cwiseProduct(x_).norm();
    }
    diag_ = diag_.cwiseMax(norms);
    const Column p = lmpar(fjac, fvec);
    length_ = model_.move(p);
    const long double pnorm = diag_.cwiseProduct(p).norm();
    if (!moved_) delta_ = std::min(delta_, pnorm);
    const long double fnorm1 = model_.weighted_errors(x_ - p).norm();
    const long double actred = 0.1L * fnorm1 < fnorm ? 1.0L - std::pow(fnorm1 / fnorm, 2.0L) : -1.0L;
    const long double temp1 = (fjac * p).norm() / fnorm;
    const long double temp2 = std::sqrt(par_) * pnorm / fnorm;
    predicted_ = temp1 * temp1 + temp2 * temp2 / 0.5L;
    const long double dirder = -(temp1 * temp1 + temp2 * temp2);
    const long double ratio = actred / predicted_;
    damped_ += par_ > 0.0L ? 1 : 0;
    if (ratio <= 0.25L) {
      long double temp = actred >= 0.0L ? 0.5L : 0.5L * dirder / (dirder + 0.5L * actred);
      if (0.1L * fnorm1 >= fnorm || temp < 0.1L) temp = 0.1L;
      delta_ = temp * std::min(delta_, pnorm / 0.1L);
      par_ /= temp;
    } else if (par_ == 0.0L || ratio >= 0.75L) {
      delta_ = pnorm / 0.5L;
      par_ *= 0.5L;
    }
    if (ratio < 1e-4L) return false;
    x_ -= p;
    moved_ = true;
    return true;
  }

 private:
  static Matrix upper(const Matrix& a) {
    return Eigen::HouseholderQR<Matrix>(a).matrixQR().topRows(a.cols()).triangularView<Eigen::Upper>();
  }

  Column lmpar(const Matrix& fjac, const Column& fvec) {
    Column x = fjac.householderQr().solve(fvec);
    long double dxnorm = diag_.cwiseProduct(x).norm();
    long double fp = dxnorm - delta_;
    if (fp <= 0.1L * delta_) {
      par_ = 0.0L;
      return x;
    }
    const auto correction = [&](const Matrix& r) {
      const Column wa1 = diag_.cwiseProduct(diag_.cwiseProduct(x)) / dxnorm;
      const Column w = r.transpose().triangularView<Eigen::Lower>().solve(wa1);
      return fp / delta_ / w.squaredNorm();
    };
    long double parl = correction(upper(fjac));
    const long double gnorm = (fjac.transpose() * fvec).cwiseQuotient(diag_).norm();
    long double paru = gnorm / delta_;
    par_ = std::min(std::max(par_, parl), paru);
    if (par_ == 0.0L) par_ = gnorm / dxnorm;
    for (int iter = 1;; ++iter) {
      if (par_ == 0.0L) par_ = 0.001L * paru;
      Matrix stacked(fjac.rows() + fjac.cols(), fjac.cols());
      stacked << fjac, Matrix((std::sqrt(par_) * diag_).asDiagonal());
      Column right = Column::Zero(stacked.rows());
      right.head(fvec.size()) = fvec;
      x = stacked.householderQr().solve(right);
      dxnorm = diag_.cwiseProduct(x).norm();
      const long double before = fp;
      fp = dxnorm - delta_;
      if (std::abs(fp) <= 0.1L * delta_ || (parl == 0.0L && fp <= before && before < 0.0L) || iter == 10) return x;
      const long double parc = correction(upper(stacked));
      if (fp > 0.0L) parl = std::max(parl, par_);
      if (fp < 0.0L) paru = std::min(paru, par_);
      par_ = std::max(parl, par_ + parc);
    }
  }

  const EigenModel& model_;
  Column x_;
  Column diag_;
  long double delta_ = -1.0L;
  long double par_ = 0.0L;
  long double predicted_ = 0.0L;
  long double length_ = 0.0L;
  bool moved_ = false;
  int damped_ = 0;
};

/// The scene moved so that it starts near the origin: the first trust region is 100 times as wide as the start is far
/// from there.
Sample from_origin(Sample s, const Point& start) {
  for (Point& p : s.points) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += start[axis] - s.start[axis];
  }
  s.start = start;
  return s;
}

struct Seen {
  int passes = 0;
  int rejected = 0;
  int damped = 0;
};

void follow(const Sample& sample, const solvers::SolverOptions& how, Seen& seen) {
  const EigenModel model(sample, how);
  Lmder lmder(model);
  const auto problems = batch_of({sample});
  for (int count = 1; count <= 15; ++count) {
    const Column before = lmder.x();
    const bool accepted = lmder.pass();
    // From here on reductions, or what is left of an exact fit, drown in rounding.
    if (lmder.predicted() < 1e-10L || lmder.length() < 1e-8L) break;
    solvers::SolverOptions options = how;
    options.lm_variant = solvers::LmVariant::More;
    options.max_iterations = count;
    options.step_tolerance_m = 1e-15;
    const auto s = solve("lm", problems, options);
    CAPTURE(count, accepted);
    CHECK(status(s) == core::Status::IterationLimit);
    CHECK(distance(estimate(s), model.position(lmder.x())) < 1e-9);
    if (!accepted) CHECK(distance(estimate(s), model.position(before)) < 1e-9);
    ++seen.passes;
    seen.rejected += accepted ? 0 : 1;
  }
  seen.damped += lmder.damped();
}

}  // namespace

TEST_CASE("more takes the steps of MINPACK's lmder, rejected and damped ones included, on ranges") {
  std::mt19937_64 engine(11);
  Seen seen;
  for (int i = 0; i < 40; ++i) {
    const Sample sample = random_sample(
        engine,
        {.points = 3 + static_cast<std::size_t>(i % 5), .scores = i % 2 == 0, .sigma_m = 1.0, .offset_m = 10.0});
    const double start = 0.02 * (1 + i % 3);
    INFO("problem " << i);
    follow(from_origin(sample, {start, -start, 0.5 * start}), {}, seen);
  }
  CAPTURE(seen.passes, seen.rejected, seen.damped);
  CHECK(seen.passes > 200);
  CHECK(seen.rejected > 20);
  CHECK(seen.damped > 50);
}

TEST_CASE("more takes the steps of MINPACK's lmder on pseudoranges") {
  std::mt19937_64 engine(12);
  Seen seen;
  for (int i = 0; i < 24; ++i) {
    solvers::SolverOptions options;
    options.z_mode = i % 2 == 0 ? solvers::ZMode::Free : solvers::ZMode::Fixed;
    options.v_mode = std::array{solvers::VMode::Free, solvers::VMode::Fixed, solvers::VMode::Prior}[i % 3U];
    const Sample sample =
        random_sample(engine, {.points = 6, .images = true, .scores = true, .sigma_m = 0.5, .offset_m = 8.0});
    INFO("problem " << i);
    follow(from_origin(sample, {0.02, -0.01, 0.03}), options, seen);
  }
  CAPTURE(seen.passes, seen.rejected, seen.damped);
  CHECK(seen.passes > 80);
  CHECK(seen.rejected + seen.damped > 5);
}

TEST_CASE("more ends where a fit is exact, and damps where J'J is singular") {
  solvers::SolverOptions options;
  options.lm_variant = solvers::LmVariant::More;
  CHECK(status(solve("lm", axes_problem(0.0, 0.0, 0.0), options)) == core::Status::Converged);
  // Points on the x axis, seen from it: nothing is known across, and x = (0.1 + 0.1 + 0.2 + 0) / 4 = 0.1.
  const auto line = problem({{2, 0, 0}, {3, 0, 0}, {4, 0, 0}, {5, 0, 0}}, {1.9, 2.9, 3.8, 5.0}, {0, 0, 0});
  options.step_tolerance_m = 1e-6;
  options.max_iterations = 100;
  const auto s = solve("lm", line, options);
  CHECK(status(s) == core::Status::Converged);
  CHECK(distance(estimate(s), {0.1, 0.0, 0.0}) < 1e-5);
}
