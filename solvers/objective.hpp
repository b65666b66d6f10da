#pragma once

#include <optional>
#include <string_view>

namespace ridgeloc::solvers {

/// Objectives that the reference can minimise. Residuals e_i (m), scores s_i, n points, p unknowns.
enum class ReferenceLoss {
  /// 1/2 sum s_i^2 e_i^2, so W = diag(s_i^2).
  WeightedSquares,
  /// sum (s_i / theta) h(e_i) with Huber's h(e) = e^2 / 2 up to theta and theta (|e| - theta / 2) beyond, so
  /// w_i = s_i / max(theta, |e_i|), for n > p. For n <= p 1/2 sum s_i e_i^2, so w_i = s_i.
  HuberTheta,
  /// 1/2 sum s_i^2 rho(e_i^2) with rho of a robust weight, at a scale and a lift that are given.
  Reweighted,
};

/// What a solver minimises, in its own words: one of the objectives that the reference knows, or none and why. What the
/// solver does on its way (damping, K, scaling of columns) is no part of it. A solver only names its objective: what
/// the name means is written a second time in the reference, which asks no solver.
class Objective {
 public:
  constexpr Objective(ReferenceLoss loss) : loss_(loss) {}

  /// `why`: what the solver does instead, for those who read the code.
  static constexpr Objective none(std::string_view why) { return Objective(why); }

  /// The same, but a converged trial need not be where the objective says: the gap to the reference is worth knowing
  /// and proves nothing.
  constexpr Objective not_binding() const {
    Objective loose = *this;
    loose.is_binding_ = false;
    return loose;
  }

  constexpr std::optional<ReferenceLoss> loss() const { return loss_; }
  constexpr bool is_binding() const { return is_binding_; }
  constexpr std::string_view why_none() const { return why_none_; }

 private:
  explicit constexpr Objective(std::string_view why) : why_none_(why) {}

  std::optional<ReferenceLoss> loss_;
  bool is_binding_ = true;
  std::string_view why_none_;
};

}  // namespace ridgeloc::solvers
