#pragma once

#include <array>
#include <string_view>

#include "core/registry.hpp"
#include "solvers/k_registry.hpp"
#include "solvers/least_squares.hpp"
#include "solvers/step.hpp"

namespace ridgeloc::solvers {

/// Ridge regression, and robust ridge regression where `robust` is set: dx = (J'WJ + K)^-1 J'We with K from `options.k`
/// at every iteration (RRR paper, eqs. 10, 12, 13, 14).
///
/// W is diag(s^2), or the robust weights of weight.hpp at x_k. An estimator of K that learns from the data gets one
/// least-squares step dx_ls at x_k, with W = diag(s^2) in either case, and sigma2 = e'We / n at x_k - dx_ls.
template <bool robust>
struct Ridge {
  static constexpr bool has_k = true;
  static constexpr std::size_t memory_size = 0;

  const SolverOptions& options;

  template <class Score, class Real>
  auto weight(const Score& score, const Real& residual, std::size_t points) const {
    if constexpr (robust) {
      return robust_weight(score, residual, points, options.theta_m);
    } else {
      return score_weight(score);
    }
  }

  template <class Model, class Real = typename Model::Real>
  Step<Real> step(const Model& model, const core::Vector3<Real>& x, const Real& iteration,
                  const TrialOracle<Real>* oracle, Memory<Real, memory_size>&) const {
    Step<Real> out;
    core::with_entry<KEstimators>(options.k,
                                  [&](auto estimator) { out = step_with(estimator, model, x, iteration, oracle); });
    return out;
  }

 private:
  template <class KEstimator, class Model, class Real = typename Model::Real>
  Step<Real> step_with(const KEstimator& estimator, const Model& model, const core::Vector3<Real>& x,
                       const Real& iteration, const TrialOracle<Real>* oracle) const {
    NormalEquations<Real> least_squares;
    NormalEquations<Real> weighted;
    for (std::size_t j = 0; j < model.points(); ++j) {
      const RangeObservation<Real> o = model.observe(j, x);
      const auto score = model.score(j);
      if constexpr (robust) weighted.add(o, weight(score, o.residual, model.points()));
      if constexpr (!robust || KEstimator::needs_ols_step) least_squares.add(o, score_weight(score));
    }

    KContext<Real> context{{}, Real(0.0), x, iteration, oracle, options};
    core::Mask<Real> singular = iteration < Real(0.0);  // in no lane
    if constexpr (KEstimator::needs_ols_step) {
      const core::LinearSolution<Real> ols = core::solve(least_squares.matrix, least_squares.gradient);
      context.ols_step = ols.x;
      context.sigma2 =
          weighted_squares(model, core::subtract(x, ols.x)) * Real(1.0 / static_cast<double>(model.points()));
      singular = ols.singular;
    }
    const core::Vector3<Real> k = estimator(context);

    const NormalEquations<Real>& equations = robust ? weighted : least_squares;
    const core::LinearSolution<Real> solution =
        core::solve(core::add_diagonal(equations.matrix, k), equations.gradient);
    singular = singular | solution.singular;
    return {solution.x, singular, !singular, k};
  }
};

/// Ridge regression.
struct RidgeRegression : Ridge<false> {
  static constexpr std::string_view name = "rr";
  static constexpr std::string_view summary = "ridge regression with K estimated at every iteration";
  static constexpr std::array<std::string_view, 7> option_names = {
      "k", "k_fixed", "similarity", "k_error", "k_error_draw", "ktrue", "eta"};
};

/// Robust ridge regression.
struct RobustRidgeRegression : Ridge<true> {
  static constexpr std::string_view name = "rrr";
  static constexpr std::string_view summary = "robust ridge regression: reweighted residuals and K";
  static constexpr std::array<std::string_view, 8> option_names = {
      "k", "k_fixed", "similarity", "k_error", "k_error_draw", "ktrue", "eta", "theta_m"};
};

}  // namespace ridgeloc::solvers
