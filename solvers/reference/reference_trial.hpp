#pragma once
// Internal to solvers: one trial as the reference sees it, in closed form. Shares no code with the solvers' models.

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "core/problem.hpp"
#include "solvers/reference/reference_loss.hpp"
#include "solvers/reference/reference_objective.hpp"

namespace ridgeloc::solvers {

/// A point with what was measured of it.
struct ReferenceObservation {
  std::array<double, core::position_parameters> point;
  double measured;  ///< range (m), or rho (m^2)
  double alpha;     ///< m^2 / mm^2, of pseudoranges
  double factor;    ///< what its term of the objective is multiplied by
};

/// Unknowns are the free ones of x, y, z (m) and q = c v, c the root mean square of the column dm/dv of pseudoranges at
/// the start: so scaled, q is a length too.
class ReferenceTrial {
 public:
  using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 4, 1>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;

  ReferenceTrial(const core::ProblemBatch& problems, std::size_t trial, const ReferenceObjective& objective);

  /// Whether all that was measured, and the objective, can be used.
  bool usable() const { return usable_; }
  const std::vector<ReferenceObservation>& observations() const { return observations_; }
  bool has_images() const { return has_images_; }
  bool height_is_free() const { return height_is_free_; }
  bool distance_is_free() const { return distance_is_free_; }
  Eigen::Index unknowns() const { return 2 + (height_is_free_ ? 1 : 0) + (distance_is_free_ ? 1 : 0); }
  double known_height() const { return start_.position[2]; }
  double start_distance() const { return start_.image_distance_mm; }
  double distance_scale() const { return distance_scale_; }
  double prior_factor() const { return prior_factor_; }  ///< of 1/2 (v - v_start)^2, 0 without a prior

  /// Huber's loss with knee theta, or the robust loss; squares where nothing is robust.
  const RobustLoss& loss() const { return loss_; }

  Vector unknowns_of(const ReferencePlace& place) const;
  ReferencePlace place_of(const Vector& unknowns) const;

  /// Residuals of the observations, without the prior.
  std::vector<double> residuals(const Vector& unknowns) const;

  /// J'WJ.
  Matrix normal_matrix(const Vector& unknowns) const;
  /// Second derivatives of the objective.
  Matrix hessian(const Vector& unknowns) const;
  /// See `gradient_rounding_bound`.
  double rounding_bound(const Vector& unknowns) const;
  /// What rounding of the residuals alone leaves of the objective where it is zero.
  double cost_rounding(const Vector& unknowns) const;

 private:
  /// One term of the objective at some place.
  struct Term {
    double weight;  ///< w: the gradient is the sum of w e row
    double slope;   ///< derivative of w e by e
    double residual;
    Vector row;
    Matrix bending;  ///< second derivatives of e
    double size;     ///< of what e is the difference of
  };
  std::vector<Term> terms(const Vector& unknowns) const;
  Term term(const ReferenceObservation& observation, const Vector& unknowns) const;
  bool is_usable(const ReferenceObjective& objective) const;

  std::vector<ReferenceObservation> observations_;
  ReferencePlace start_;
  RobustLoss loss_;
  bool has_images_;
  bool height_is_free_;
  bool distance_is_free_;
  bool usable_ = false;
  double distance_scale_ = 1.0;
  double prior_factor_ = 0.0;
};

}  // namespace ridgeloc::solvers
