#include "solvers/reference/ceres_reference.hpp"

#include <ceres/autodiff_cost_function.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "solvers/reference/reference_trial.hpp"

namespace ridgeloc::solvers {

namespace {

using Vector = ReferenceTrial::Vector;

constexpr double not_defined = std::numeric_limits<double>::quiet_NaN();
constexpr double largest = std::numeric_limits<double>::max();

/// |point - x| minus what was measured. Reports failure where it or its derivative is not finite, before Ceres would
/// find out by itself and print a warning.
template <bool height_is_free, bool distance_is_free>
struct ReferenceResidual {
  static constexpr int unknowns = 2 + (height_is_free ? 1 : 0) + (distance_is_free ? 1 : 0);
  const ReferenceTrial& trial;
  const ReferenceObservation& observation;

  template <typename Real>
  bool operator()(const Real* u, Real* residual) const {
    using std::sqrt;
    std::array<Real, core::position_parameters> position = {u[0], u[1], Real(trial.known_height())};
    if constexpr (height_is_free) position[2] = u[2];
    Real squared(0.0);
    for (std::size_t axis = 0; axis < core::position_parameters; ++axis) {
      const Real difference = observation.point[axis] - position[axis];
      squared += difference * difference;
    }
    if (!(squared > Real(0.0) && squared <= Real(largest))) return false;
    if (!trial.has_images()) {
      *residual = sqrt(squared) - observation.measured;
      return true;
    }
    Real v(trial.start_distance());
    if constexpr (distance_is_free) v = u[unknowns - 1] / trial.distance_scale();
    const Real measured = observation.alpha * v * v + observation.measured;
    if (!(measured > Real(0.0) && measured <= Real(largest))) return false;
    *residual = sqrt(squared) - sqrt(measured);
    return true;
  }
};

/// v minus what it is thought to be.
template <int Unknowns>
struct PriorResidual {
  const ReferenceTrial& trial;

  template <typename Real>
  bool operator()(const Real* u, Real* residual) const {
    *residual = u[Unknowns - 1] / trial.distance_scale() - trial.start_distance();
    return true;
  }
};

class CeresLoss : public ceres::LossFunction {
 public:
  explicit CeresLoss(const RobustLoss& loss) : loss_(loss) {}
  void Evaluate(double squared_residual, double out[3]) const override {
    const auto values = loss_(squared_residual);
    for (std::size_t i = 0; i < values.size(); ++i) out[i] = values[i];
  }

 private:
  RobustLoss loss_;
};

/// One trial with its objective: cost and gradient through Ceres.
class Reference {
 public:
  Reference(const core::ProblemBatch& problems, std::size_t trial, const ReferenceObjective& objective)
      : trial_(problems, trial, objective), u_(Vector::Zero(trial_.unknowns())) {
    if (!trial_.usable()) return;
    problem_.AddParameterBlock(u_.data(), static_cast<int>(u_.size()));
    if (trial_.height_is_free()) {
      trial_.distance_is_free() ? add_residuals<true, true>(objective) : add_residuals<true, false>(objective);
    } else {
      trial_.distance_is_free() ? add_residuals<false, true>(objective) : add_residuals<false, false>(objective);
    }
  }

  // Ceres keeps the address of u_, residuals that of trial_.
  Reference(const Reference&) = delete;
  Reference& operator=(const Reference&) = delete;

  const ReferenceTrial& trial() const { return trial_; }
  const Vector& unknowns() const { return u_; }
  ReferencePlace place() const { return trial_.place_of(u_); }
  void move_to(const ReferencePlace& place) { u_ = trial_.unknowns_of(place); }
  void move_to(const Vector& u) { u_ = u; }

  /// Ceres' own minimisation from the current place; returns the number of iterations.
  int minimize(double tolerance) {
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

  /// J'We at the current place, and the objective; NaN where it is not defined. Term by term, since
  /// ceres::Problem::Evaluate prepares far longer than it computes.
  Vector gradient(double* cost = nullptr) const {
    Vector sum = Vector::Zero(u_.size());
    double total = 0.0;
    bool defined = trial_.usable();
    for (std::size_t i = 0; i < terms_.size() && defined; ++i) {
      double term = 0.0;
      double residual = 0.0;
      Vector row(u_.size());
      double* rows[] = {row.data()};
      defined = problem_.EvaluateResidualBlock(terms_[i], true, &term, &residual, rows);
      sum += residual * row;
      total += term;
    }
    if (!defined) sum.setConstant(not_defined);
    if (cost != nullptr) *cost = defined ? total : not_defined;
    return sum;
  }

  /// Whether the current place is a strict local minimum to rounding.
  bool at_minimum() const {
    const Eigen::LLT<ReferenceTrial::Matrix> factor(trial_.hessian(u_));
    return gradient().norm() <= rounding_bound() && factor.info() == Eigen::Success;
  }

  double rounding_bound() const { return trial_.usable() ? trial_.rounding_bound(u_) : not_defined; }

 private:
  // Reweighting converges linearly: with 4 points and noise of 0.1 m the slowest of 10^4 trials took 16 000 iterations
  // until Newton's method could take over, the average one 27.
  static constexpr int max_iterations = 20000;

  ceres::LossFunction* inner_loss(const ReferenceObjective& objective) const {
    if (trial_.loss().shape == LossShape::Squares) return nullptr;
    if (objective.loss == ReferenceLoss::HuberTheta) return new ceres::HuberLoss(objective.theta_m);
    return new CeresLoss(trial_.loss());
  }

  template <bool height_is_free, bool distance_is_free>
  void add_residuals(const ReferenceObjective& objective) {
    using Residual = ReferenceResidual<height_is_free, distance_is_free>;
    constexpr int unknowns = Residual::unknowns;
    for (const ReferenceObservation& o : trial_.observations()) {
      terms_.push_back(problem_.AddResidualBlock(
          new ceres::AutoDiffCostFunction<Residual, 1, unknowns>(new Residual{trial_, o}),
          new ceres::ScaledLoss(inner_loss(objective), o.factor, ceres::TAKE_OWNERSHIP), u_.data()));
    }
    if (!distance_is_free || trial_.prior_factor() == 0.0) return;
    using Prior = PriorResidual<unknowns>;
    terms_.push_back(problem_.AddResidualBlock(
        new ceres::AutoDiffCostFunction<Prior, 1, unknowns>(new Prior{trial_}),
        new ceres::ScaledLoss(nullptr, trial_.prior_factor(), ceres::TAKE_OWNERSHIP), u_.data()));
  }

  ReferenceTrial trial_;
  Vector u_;
  ceres::Problem problem_;
  std::vector<ceres::ResidualBlockId> terms_;
};

/// Newton's method on J'We = 0 from the current place: a step is halved until the gradient norm falls (with Huber's
/// loss a full one can overshoot a kink) and the method ends where no step lowers it any more.
void refine(Reference& reference) {
  constexpr int max_steps = 50;
  constexpr int max_halvings = 20;
  Vector gradient = reference.gradient();
  for (int step = 0; step < max_steps; ++step) {
    const Eigen::LLT<ReferenceTrial::Matrix> factor(reference.trial().hessian(reference.unknowns()));
    if (factor.info() != Eigen::Success) return;
    const Vector before = reference.unknowns();
    const Vector full_step = factor.solve(gradient);
    Vector next = gradient;
    for (int halving = 0; halving <= max_halvings && !(next.norm() < gradient.norm()); ++halving) {
      reference.move_to(Vector(before - std::ldexp(1.0, -halving) * full_step));
      next = reference.gradient();
    }
    if (!(next.norm() < gradient.norm())) {
      reference.move_to(before);
      return;
    }
    gradient = next;
  }
}

}  // namespace

Minimizer minimize(const core::ProblemBatch& problems, std::size_t trial, const ReferencePlace& start,
                   const ReferenceObjective& objective) {
  Minimizer result;
  result.estimate = start.position;
  result.image_distance_mm = start.image_distance_mm;
  result.cost = not_defined;
  result.gradient_norm = not_defined;

  Reference reference(problems, trial, objective);
  reference.move_to(start);
  if (!reference.gradient().allFinite()) return result;

  // Newton's method does the last digits: Ceres has to come close enough only. Where the first tolerance was too wide
  // for that (kinks, slow convergence), it goes on from where it was to the second.
  for (const double tolerance : {1e-8, 1e-13}) {
    result.iterations += reference.minimize(tolerance);
    const ReferencePlace before = reference.place();
    refine(reference);
    result.converged = reference.at_minimum();
    if (result.converged) break;
    reference.move_to(before);
  }
  if (!result.converged) refine(reference);
  const ReferencePlace place = reference.place();
  result.estimate = place.position;
  result.image_distance_mm = place.image_distance_mm;
  result.gradient_norm = reference.gradient(&result.cost).norm();
  return result;
}

std::array<double, 4> gradient(const core::ProblemBatch& problems, std::size_t trial, const ReferencePlace& estimate,
                               const ReferenceObjective& objective) {
  Reference reference(problems, trial, objective);
  reference.move_to(estimate);
  const Vector value = reference.gradient();
  const ReferenceTrial& view = reference.trial();
  return {value[0], value[1], view.height_is_free() ? value[2] : 0.0,
          view.distance_is_free() ? value[value.size() - 1] * view.distance_scale() : 0.0};
}

double gradient_rounding_bound(const core::ProblemBatch& problems, std::size_t trial, const ReferencePlace& estimate,
                               const ReferenceObjective& objective) {
  Reference reference(problems, trial, objective);
  reference.move_to(estimate);
  return reference.rounding_bound();
}

ReferenceStep undamped_step(const core::ProblemBatch& problems, std::size_t trial, const ReferencePlace& estimate,
                            const ReferenceObjective& objective) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  constexpr double largest_amplification = 1e12;
  ReferenceStep result{not_defined, not_defined, not_defined, not_defined};
  Reference reference(problems, trial, objective);
  reference.move_to(estimate);
  const Vector gradient = reference.gradient(&result.cost);
  if (!gradient.allFinite()) return result;
  const double bound = reference.rounding_bound();

  const ReferenceTrial& view = reference.trial();
  result.cost_error = view.cost_rounding(reference.unknowns());
  const Eigen::SelfAdjointEigenSolver<ReferenceTrial::Matrix> solver(view.normal_matrix(reference.unknowns()));
  const Vector lambda = solver.eigenvalues();
  double amplification = 1.0;
  for (const double value : lambda) amplification *= lambda[lambda.size() - 1] / value;
  if (!(lambda[0] > 0.0 && amplification <= largest_amplification)) return result;
  const Vector step = solver.eigenvectors() * (solver.eigenvectors().transpose() * gradient).cwiseQuotient(lambda);
  result.step_m = step.head(view.height_is_free() ? 3 : 2).norm();
  result.step_error_m = bound / lambda[0] + 100.0 * epsilon * amplification * step.norm();
  return result;
}

}  // namespace ridgeloc::solvers
