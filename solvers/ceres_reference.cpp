#include "solvers/ceres_reference.hpp"

#include <ceres/autodiff_cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace ridgeloc::solvers {

namespace {

using Position = std::array<double, core::position_parameters>;

constexpr double not_defined = std::numeric_limits<double>::quiet_NaN();

struct Observation {
  Position point;
  double measured;
  double score;
};

/// scale * (|point - x| - measured). Reports failure where it or its derivative is not finite, before Ceres
/// would find out by itself and print a warning.
struct ScaledRangeResidual {
  Observation observation;
  double scale;

  template <typename Real>
  bool operator()(const Real* x, Real* residual) const {
    using std::sqrt;
    Real squared(0.0);
    for (std::size_t axis = 0; axis < core::position_parameters; ++axis) {
      const Real difference = observation.point[axis] - x[axis];
      squared += difference * difference;
    }
    if (!(squared > Real(0.0) && squared <= Real(std::numeric_limits<double>::max()))) return false;
    *residual = scale * (sqrt(squared) - observation.measured);
    return true;
  }
};

/// One trial with its objective: weights and curvatures in closed form here, cost and gradient through Ceres.
class Reference {
 public:
  Reference(const core::ProblemBatch& problems, std::size_t trial, ReferenceLoss loss, double theta)
      : loss_(loss), theta_(theta), robust_(problems.points() > core::position_parameters) {
    for (std::size_t j = 0; j < problems.points(); ++j) {
      Observation observation;
      for (std::size_t axis = 0; axis < core::position_parameters; ++axis) {
        observation.point[axis] = problems.position(j, axis)[trial];
      }
      observation.measured = problems.measured(j)[trial];
      observation.score = problems.has_scores() ? problems.score(j)[trial] : 1.0;
      observations_.push_back(observation);
    }
    usable_ = is_usable();
    if (usable_) build();
  }

  // Ceres keeps the address of x_.
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  bool usable() const { return usable_; }
  const Position& position() const { return x_; }
  void move_to(const Position& x) { x_ = x; }

  /// Ceres' own minimisation from the current position; returns the number of iterations.
  int minimize() {
    ceres::Solver::Options options;
    options.linear_solver_type = ceres::DENSE_QR;
    options.num_threads = 1;
    options.logging_type = ceres::SILENT;
    options.max_num_iterations = max_iterations;
    options.gradient_tolerance = tolerance;
    options.parameter_tolerance = tolerance;
    options.function_tolerance = tolerance;
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem_, &summary);
    // The first entry is the evaluation at the start.
    return summary.iterations.empty() ? 0 : static_cast<int>(summary.iterations.size()) - 1;
  }

  /// J'We at the current position; NaN where it is not defined. `cost` may be null.
  Eigen::Vector3d gradient(double* cost) {
    std::vector<double> values;
    double unused = 0.0;
    const bool ok = usable_ && problem_.Evaluate({}, cost != nullptr ? cost : &unused, nullptr, &values, nullptr);
    if (ok) return {values[0], values[1], values[2]};
    if (cost != nullptr) *cost = not_defined;
    return Eigen::Vector3d::Constant(not_defined);
  }

  /// Second derivatives of the objective: sum psi'(e) u u' + psi(e) (I - u u') / r, u = (p - x) / r, psi(e) =
  /// w e.
  Eigen::Matrix3d hessian() const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const auto& observation : observations_) {
      const Eigen::Vector3d line = line_of_sight(observation);
      const double range = line.norm();
      const double residual = range - observation.measured;
      const Eigen::Matrix3d along = line * line.transpose() / (range * range);
      const double bending = weight(observation.score, residual) * residual / range;
      sum += slope(observation.score, residual) * along + bending * (Eigen::Matrix3d::Identity() - along);
    }
    return sum;
  }

  double rounding_bound() const {
    if (!usable_) return not_defined;
    const double from_origin = Eigen::Vector3d::Map(x_.data()).norm();
    double sum = 0.0;
    for (const auto& observation : observations_) {
      const double range = line_of_sight(observation).norm();
      sum += weight(observation.score, range - observation.measured) *
             (range + std::abs(observation.measured) + from_origin);
    }
    return 4.0 * std::numeric_limits<double>::epsilon() * sum;
  }

 private:
  // Newton's method does the last digits: Ceres has to come close enough only.
  static constexpr double tolerance = 1e-13;
  // Reweighting converges linearly: with 4 points and noise of 0.1 m the slowest of 10^4 trials took 16 000
  // iterations until Newton's method could take over, the average one 27.
  static constexpr int max_iterations = 20000;

  bool huber() const { return loss_ == ReferenceLoss::HuberTheta && robust_; }

  bool is_usable() const {
    if (huber() && !(theta_ > 0.0 && std::isfinite(theta_))) return false;
    return std::all_of(observations_.begin(), observations_.end(), [](const Observation& o) {
      return std::all_of(o.point.begin(), o.point.end(), [](double v) { return std::isfinite(v); }) &&
             std::isfinite(o.measured) && std::isfinite(o.score) && o.score >= 0.0;
    });
  }

  void build() {
    problem_.AddParameterBlock(x_.data(), core::position_parameters);
    for (const auto& observation : observations_) {
      const double scale = loss_ == ReferenceLoss::WeightedSquares ? observation.score : 1.0;
      auto* residual = new ceres::AutoDiffCostFunction<ScaledRangeResidual, 1, core::position_parameters>(
          new ScaledRangeResidual{observation, scale});
      problem_.AddResidualBlock(residual, loss_function(observation.score), x_.data());
    }
  }

  ceres::LossFunction* loss_function(double score) const {
    if (loss_ == ReferenceLoss::WeightedSquares) return nullptr;
    ceres::LossFunction* inner = huber() ? new ceres::HuberLoss(theta_) : nullptr;
    return new ceres::ScaledLoss(inner, huber() ? score / theta_ : score, ceres::TAKE_OWNERSHIP);
  }

  Eigen::Vector3d line_of_sight(const Observation& observation) const {
    return Eigen::Vector3d::Map(observation.point.data()) - Eigen::Vector3d::Map(x_.data());
  }

  /// w in J'We.
  double weight(double score, double residual) const {
    if (loss_ == ReferenceLoss::WeightedSquares) return score * score;
    return huber() ? score / std::max(theta_, std::abs(residual)) : score;
  }

  /// Derivative of psi(e) = w(e) e.
  double slope(double score, double residual) const {
    return huber() && std::abs(residual) > theta_ ? 0.0 : weight(score, residual);
  }

  ReferenceLoss loss_;
  double theta_;
  bool robust_;
  bool usable_ = false;
  std::vector<Observation> observations_;
  Position x_{};
  ceres::Problem problem_;
};

/// Newton's method on J'We = 0 from the current position: a step is halved until the gradient norm falls
/// (with Huber's loss a full one can overshoot a kink) and the method ends where no step lowers it any more.
void refine(Reference& reference) {
  constexpr int max_steps = 50;
  constexpr int max_halvings = 20;
  Eigen::Vector3d gradient = reference.gradient(nullptr);
  for (int step = 0; step < max_steps; ++step) {
    const Eigen::LLT<Eigen::Matrix3d> factor(reference.hessian());
    if (factor.info() != Eigen::Success) return;
    const Position before = reference.position();
    const Eigen::Vector3d full_step = factor.solve(gradient);
    Eigen::Vector3d next = gradient;
    for (int halving = 0; halving <= max_halvings && !(next.norm() < gradient.norm()); ++halving) {
      const Eigen::Vector3d moved = Eigen::Vector3d::Map(before.data()) - std::ldexp(1.0, -halving) * full_step;
      reference.move_to({moved[0], moved[1], moved[2]});
      next = reference.gradient(nullptr);
    }
    if (!(next.norm() < gradient.norm())) {
      reference.move_to(before);
      return;
    }
    gradient = next;
  }
}

}  // namespace

Minimizer minimize(const core::ProblemBatch& problems, std::size_t trial, const Position& start, ReferenceLoss loss,
                   double theta_m) {
  Minimizer result;
  result.estimate = start;
  result.cost = not_defined;
  result.gradient_norm = not_defined;

  Reference reference(problems, trial, loss, theta_m);
  reference.move_to(start);
  if (!reference.gradient(nullptr).allFinite()) return result;

  result.iterations = reference.minimize();
  refine(reference);
  result.estimate = reference.position();
  result.gradient_norm = reference.gradient(&result.cost).norm();
  result.converged = result.gradient_norm <= reference.rounding_bound() &&
                     Eigen::LLT<Eigen::Matrix3d>(reference.hessian()).info() == Eigen::Success;
  return result;
}

Position gradient(const core::ProblemBatch& problems, std::size_t trial, const Position& estimate, ReferenceLoss loss,
                  double theta_m) {
  Reference reference(problems, trial, loss, theta_m);
  reference.move_to(estimate);
  const Eigen::Vector3d value = reference.gradient(nullptr);
  return {value[0], value[1], value[2]};
}

double gradient_rounding_bound(const core::ProblemBatch& problems, std::size_t trial, const Position& estimate,
                               ReferenceLoss loss, double theta_m) {
  Reference reference(problems, trial, loss, theta_m);
  reference.move_to(estimate);
  return reference.rounding_bound();
}

}  // namespace ridgeloc::solvers
