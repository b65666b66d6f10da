#pragma once

#include <array>
#include <string_view>

#include "solvers/methods/step.hpp"
#include "solvers/models/least_squares.hpp"
#include "solvers/models/weight.hpp"
#include "solvers/objective.hpp"

namespace ridgeloc::solvers {

/// Gauss-Newton's method: dx = (J'WJ)^-1 J'We, W = diag(s^2) (RRR paper, eqs. 5, 7, 9).
struct GaussNewton : MethodDefaults {
  static constexpr KernelSize size = KernelSize::Unrolled;

  const SolverOptions& options;

  explicit GaussNewton(const SolverOptions& o) : options(o) {}

  template <class Model, class Vector>
  ScoreWeights weights(const Model&, const Vector&) const {
    return ScoreWeights(options);
  }

  template <class Model, class Vector, class Real, class Oracle, class Memory>
  Step<Real, Model::unknowns> step(const Model& model, const Vector& u, const Real&, const Oracle*, Memory&) const {
    const auto equations = normal_equations(model, u, ScoreWeights(options));
    const auto solution = core::solve(equations.matrix, equations.gradient, model.observations());
    return {solution.x, solution.singular, !solution.singular, {}};
  }
};

/// Ordinary least squares.
struct Ols : SingleVariant<GaussNewton> {
  static constexpr std::string_view name = "ols";
  static constexpr std::string_view summary = "Gauss-Newton least squares";
  static constexpr std::array<std::string_view, 0> option_names{};
  static constexpr bool is_least_squares = true;
  static Objective objective(const SolverOptions&) { return ReferenceLoss::WeightedSquares; }
};

/// The same with what is known of the image distance, whatever `options.v_mode` says.
struct PriorGaussNewton : SingleVariant<GaussNewton> {
  static constexpr std::string_view name = "gn_prior";
  static constexpr std::string_view summary = "Gauss-Newton with a prior on the image distance";
  static constexpr std::array<std::string_view, 0> option_names{};
  static constexpr bool is_least_squares = false;  ///< the prior draws v away, and x with it
  static Objective objective(const SolverOptions&) { return ReferenceLoss::WeightedSquares; }
  static void adjust(SolverOptions& options) { options.v_mode = VMode::Prior; }
};

}  // namespace ridgeloc::solvers
