#pragma once

#include "core/matrix.hpp"
#include "solvers/models/observation.hpp"

namespace ridgeloc::solvers {

/// Normal equations at u with the weights of a method, and what is known beforehand.
template <class Model, class Weights, class Real = typename Model::Real>
[[gnu::always_inline]] inline NormalEquations<Real, Model::unknowns> normal_equations(const Model& model,
                                                                                      const typename Model::Vector& u,
                                                                                      const Weights& weights) {
  NormalEquations<Real, Model::unknowns> equations;
  for_each_point(
      model,
      [](auto j, const Model& m, const auto& at, const Weights& weigh, auto& sum) __attribute__((always_inline)) {
        const auto o = m.observe(j, at);
        sum.add(o, weigh(j, m.score(j), o.residual));
      },
      u, weights, equations);
  model.add_prior(u, weights.largest(), equations);
  return equations;
}

/// Weighted sum of squares e'We of the ranges at u.
template <class Model, class Weights, class Real = typename Model::Real>
[[gnu::always_inline]] inline Real weighted_squares(const Model& model, const typename Model::Vector& u,
                                                    const Weights& weights) {
  Real sum(0.0);
  for_each_point(
      model,
      [](auto j, const Model& m, const auto& at, const Weights& weigh, Real& total) __attribute__((always_inline)) {
        const Real e = m.residual(j, at);
        total = core::mul_add(weigh(j, m.score(j), e) * e, e, total);
      },
      u, weights, sum);
  return sum;
}

/// Change of e'We, that of the prior included, by the step u <- u - du, to the relative accuracy of its terms.
template <class Model, class Weights, class Real = typename Model::Real>
[[gnu::always_inline]] inline Real weighted_squares_change(const Model& model, const typename Model::Vector& u,
                                                           const typename Model::Vector& du, const Weights& weights) {
  Real sum = model.prior_change(u, du);
  for_each_point(
      model,
      [](auto j, const Model& m, const auto& at, const auto& move, const Weights& weigh, Real& total)
          __attribute__((always_inline)) {
            const auto e = m.residual_change(j, at, move);
            total = core::mul_add(weigh(j, m.score(j), e.residual) * e.change,
                                  core::mul_add(Real(2.0), e.residual, e.change), total);
          },
      u, du, weights, sum);
  return sum;
}

}  // namespace ridgeloc::solvers
