#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "core/registry.hpp"
#include "solvers/methods/median.hpp"
#include "solvers/methods/robust_weights.hpp"
#include "solvers/methods/scratch.hpp"
#include "solvers/methods/step.hpp"
#include "solvers/models/least_squares.hpp"
#include "solvers/models/weight.hpp"
#include "solvers/objective.hpp"

namespace ridgeloc::solvers {

/// Residuals shorter than this (m) count as no scale at all.
inline constexpr double smallest_scale_m = 1e-9;
/// No observation of few is switched off altogether.
inline constexpr double smallest_weight = 0.01;

/// Weights w_j s_j^2 of one group of lanes, kept in the thread's scratch.
template <class Real>
struct StoredWeights {
  const double* weights;
  ScoreWeights scores;

  template <class Score>
  Real operator()(std::size_t j, const Score& score, const Real& residual) const {
    return scores(j, score, residual) * core::load<Real>(weights + j * core::lanes<Real>);
  }
  double largest() const { return 1.0; }
};

/// Iteratively reweighted least squares: dx = (J'WJ)^-1 J'We, W = diag(s^2 w), w = w(|e| / scale) by `options.weight`.
/// The scale is 1.4826 median |e_i|, anew at every iterate, or a constant.
///
/// Few observations need care: weights are at least 0.01, and where their sum c, the number of observations that they
/// amount to, is below the number p of unknowns, all are drawn towards 1, w + (1 - w)(p - c) / (n - c), until it is p.
/// With n <= p all weights are 1.
struct Reweighting : MethodDefaults {
  const SolverOptions& options;

  explicit Reweighting(const SolverOptions& o) : options(o) {}

  template <class Model, class Vector, class Real = typename Model::Real>
  StoredWeights<Real> weights(const Model& model, const Vector& u) const {
    constexpr std::size_t lanes = core::lanes<Real>;
    const std::size_t n = model.points();
    double* const sizes = scratch_of_thread(2 * n * lanes);
    for (std::size_t j = 0; j < n; ++j) core::store(sizes + j * lanes, core::abs(model.residual(j, u)));
    const Real inverse_scale = core::reciprocal(core::max(scale<Real>(sizes, n), Real(smallest_scale_m)));

    Real sum(0.0);
    core::with_entry<RobustWeights>(options.weight, [&](auto weight) {
      const Real tuning(options.tuning > 0.0 ? options.tuning : weight.tuning);
      for (std::size_t j = 0; j < n; ++j) {
        const Real standardized = core::load<Real>(sizes + j * lanes) * inverse_scale;
        const Real w = core::max(weight(standardized, tuning), Real(smallest_weight));
        core::store(sizes + j * lanes, w);
        sum = sum + w;
      }
    });
    const Real needed(static_cast<double>(Model::unknowns));
    const Real all(static_cast<double>(n));
    const Real part = (needed - sum) * core::reciprocal(all - sum);
    const Real lift = core::select(sum < needed, core::select(part < Real(1.0), part, Real(1.0)), Real(0.0));
    for (std::size_t j = 0; j < n; ++j) {
      const Real w = core::load<Real>(sizes + j * lanes);
      core::store(sizes + j * lanes, core::mul_add(lift, Real(1.0) - w, w));
    }
    return {sizes, ScoreWeights(options)};
  }

  template <class Model, class Vector, class Real, class Oracle, class Memory>
  Step<Real, Model::unknowns> step(const Model& model, const Vector& u, const Real&, const Oracle*, Memory&) const {
    const auto equations = normal_equations(model, u, weights(model, u));
    const auto solution = core::solve(equations.matrix, equations.gradient, model.observations());
    return {solution.x, solution.singular, !solution.singular, {}};
  }

 private:
  /// Keeps the first n values as they are.
  template <class Real>
  Real scale(double* sizes, std::size_t n) const {
    constexpr std::size_t lanes = core::lanes<Real>;
    constexpr double normal_consistency = 1.4826;
    if (options.scale == Scale::Fixed) return Real(options.scale_m);
    for (std::size_t j = 0; j < n; ++j) {
      core::store(sizes + (n + j) * lanes, core::load<Real>(sizes + j * lanes));
    }
    return Real(normal_consistency) * median<Real>(sizes + n * lanes, n);
  }
};

struct Irls : SingleVariant<Reweighting> {
  static constexpr std::string_view name = "irls";
  static constexpr std::string_view summary = "iteratively reweighted least squares: a robust M-estimator";
  static constexpr std::array<std::string_view, 4> option_names = {"weight", "tuning", "scale", "scale_m"};
  static constexpr bool is_least_squares = false;
  static Objective objective(const SolverOptions&) { return ReferenceLoss::Reweighted; }
};

}  // namespace ridgeloc::solvers
