#pragma once

#include <array>
#include <string_view>

#include "solvers/least_squares.hpp"
#include "solvers/step.hpp"

namespace ridgeloc::solvers {

/// Levenberg-Marquardt with lazy damping: dx = (J'WJ + mu diag(J'WJ))^-1 J'We, W = diag(s^2).
///
/// mu is 0 until a step would make e'We grow. Such a step is rejected: x stays, mu becomes 1e-3 or ten times what it
/// was, the iteration counts and does not meet the stop rule. An accepted step divides mu by ten.
struct LazyLevenbergMarquardt {
  static constexpr std::string_view name = "lm";
  static constexpr std::string_view summary = "Levenberg-Marquardt, damped only after a rejected step";
  static constexpr std::array<std::string_view, 0> option_names{};
  static constexpr bool has_k = false;
  static constexpr std::size_t memory_size = 1;  ///< mu
  static constexpr double first_damping = 1e-3;
  static constexpr double damping_factor = 10.0;

  const SolverOptions& options;

  template <class Model, class Real = typename Model::Real>
  Step<Real> step(const Model& model, const core::Vector3<Real>& x, const Real&, const TrialOracle<Real>*,
                  Memory<Real, memory_size>& memory) const {
    using core::mul_add;
    using core::select;
    const NormalEquations<Real> equations = least_squares_equations(model, x);
    core::Symmetric3<Real> a = equations.matrix;
    const Real mu = memory[0];
    a.xx = mul_add(mu, a.xx, a.xx);
    a.yy = mul_add(mu, a.yy, a.yy);
    a.zz = mul_add(mu, a.zz, a.zz);
    const core::LinearSolution<Real> solution = core::solve(a, equations.gradient);

    // A comparison with NaN is false, so a step that is not a number is accepted and ends as "non_finite".
    const Real zero(0.0);
    const core::Mask<Real> rejected = weighted_squares_change(model, x, solution.x) > zero;
    const Real raised = select(mu > zero, mu * Real(damping_factor), Real(first_damping));
    memory[0] = select(rejected, raised, mu * Real(1.0 / damping_factor));
    return {core::select<Real>(rejected, {zero, zero, zero}, solution.x), solution.singular, !rejected, {}};
  }

  template <class Score, class Real>
  Score weight(const Score& score, const Real&, std::size_t) const {
    return score_weight(score);
  }
};

}  // namespace ridgeloc::solvers
