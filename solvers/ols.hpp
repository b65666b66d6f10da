#pragma once

#include <array>
#include <string_view>

#include "solvers/least_squares.hpp"
#include "solvers/step.hpp"

namespace ridgeloc::solvers {

/// Ordinary least squares by Gauss-Newton: dx = (J'WJ)^-1 J'We, W = diag(s^2) (RRR paper, eqs. 5, 7, 9).
struct Ols {
  static constexpr std::string_view name = "ols";
  static constexpr std::string_view summary = "Gauss-Newton least squares";
  static constexpr std::array<std::string_view, 0> option_names{};
  static constexpr bool has_k = false;
  static constexpr std::size_t memory_size = 0;

  const SolverOptions& options;

  template <class Model, class Real = typename Model::Real>
  Step<Real> step(const Model& model, const core::Vector3<Real>& x, const Real&, const TrialOracle<Real>*,
                  Memory<Real, memory_size>&) const {
    const NormalEquations<Real> equations = least_squares_equations(model, x);
    const core::LinearSolution<Real> solution = core::solve(equations.matrix, equations.gradient);
    return {solution.x, solution.singular, !solution.singular, {}};
  }

  template <class Score, class Real>
  Score weight(const Score& score, const Real&, std::size_t) const {
    return score_weight(score);
  }
};

}  // namespace ridgeloc::solvers
