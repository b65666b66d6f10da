#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>

#include "solvers/methods/more.hpp"
#include "solvers/methods/step.hpp"
#include "solvers/models/least_squares.hpp"
#include "solvers/models/weight.hpp"
#include "solvers/objective.hpp"

namespace ridgeloc::solvers {

/// Levenberg-Marquardt: dx = (J'WJ + mu diag(J'WJ))^-1 J'We, W = diag(s^2).
///
/// A step that would make e'We grow is rejected: x stays, mu becomes 1e-3 or ten times what it was, the iteration
/// counts and does not meet the stop rule. An accepted step divides mu by ten. `lazy`: mu is 0 until a step is
/// rejected; otherwise it begins with 1e-3.
template <bool lazy>
struct Damped : MethodDefaults {
  static constexpr KernelSize size = lazy ? KernelSize::Unrolled : KernelSize::Small;
  template <std::size_t P>
  static constexpr std::size_t memory_size = 1;  ///< mu
  static constexpr double first_damping = 1e-3;
  static constexpr double damping_factor = 10.0;

  const SolverOptions& options;

  explicit Damped(const SolverOptions& o) : options(o) {}

  template <class Model, class Vector>
  ScoreWeights weights(const Model&, const Vector&) const {
    return ScoreWeights(options);
  }

  template <class Model, class Vector, class Real, class Oracle>
  Step<Real, Model::unknowns> step(const Model& model, const Vector& u, const Real& iteration, const Oracle*,
                                   Memory<Real, 1>& memory) const {
    using core::mul_add;
    using core::select;
    const auto equations = normal_equations(model, u, ScoreWeights(options));
    auto a = equations.matrix;
    const Real mu = lazy ? memory[0] : select(iteration < Real(0.5), Real(first_damping), memory[0]);
    core::unroll<Model::unknowns>([&](auto i) { a(i, i) = mul_add(mu, a(i, i), a(i, i)); });
    const auto solution = core::solve(a, equations.gradient, model.observations());

    // A comparison with NaN is false, so a step that is not a number is accepted and ends as "non_finite".
    const Real zero(0.0);
    const core::Mask<Real> rejected = weighted_squares_change(model, u, solution.x, ScoreWeights(options)) > zero;
    const Real raised = select(mu > zero, mu * Real(damping_factor), Real(first_damping));
    memory[0] = select(rejected, raised, mu * Real(1.0 / damping_factor));
    return unless<Real>(rejected, solution.x, solution.singular);
  }
};

/// Levenberg-Marquardt with the damping that `options.lm_variant` names.
struct LevenbergMarquardt : SolverDefaults {
  static constexpr std::string_view name = "lm";
  static constexpr std::string_view summary =
      "Levenberg-Marquardt: damped after a rejected step, always, or as MINPACK";
  static constexpr std::array<std::string_view, 1> option_names = {"lm_variant"};
  static constexpr bool is_least_squares = true;
  static Objective objective(const SolverOptions&) { return ReferenceLoss::WeightedSquares; }
  using Variants = std::tuple<Damped<true>, Damped<false>, More>;
  static std::size_t variant(const SolverOptions& options) { return static_cast<std::size_t>(options.lm_variant); }
};

}  // namespace ridgeloc::solvers
