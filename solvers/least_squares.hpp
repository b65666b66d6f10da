#pragma once

#include "core/matrix3.hpp"
#include "solvers/normal_equations.hpp"
#include "solvers/weight.hpp"

namespace ridgeloc::solvers {

/// Normal equations at x with the least-squares weights w_i = s_i^2.
template <class Model, class Real = typename Model::Real>
NormalEquations<Real> least_squares_equations(const Model& model, const core::Vector3<Real>& x) {
  NormalEquations<Real> equations;
  for (std::size_t j = 0; j < model.points(); ++j) {
    equations.add(model.observe(j, x), score_weight(model.score(j)));
  }
  return equations;
}

/// Weighted sum of squares e'We at x, W = diag(s^2).
template <class Model, class Real = typename Model::Real>
Real weighted_squares(const Model& model, const core::Vector3<Real>& x) {
  Real sum(0.0);
  for (std::size_t j = 0; j < model.points(); ++j) {
    const Real e = model.residual(j, x);
    sum = core::mul_add(score_weight(model.score(j)) * e, e, sum);
  }
  return sum;
}

/// Change of e'We, W = diag(s^2), by the step x <- x - dx, to the relative accuracy of its terms.
template <class Model, class Real = typename Model::Real>
Real weighted_squares_change(const Model& model, const core::Vector3<Real>& x, const core::Vector3<Real>& dx) {
  Real sum(0.0);
  for (std::size_t j = 0; j < model.points(); ++j) {
    const auto e = model.residual_change(j, x, dx);
    sum = core::mul_add(score_weight(model.score(j)) * e.change, core::mul_add(Real(2.0), e.residual, e.change), sum);
  }
  return sum;
}

}  // namespace ridgeloc::solvers
