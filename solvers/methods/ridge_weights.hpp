#pragma once

#include <cstddef>

#include "solvers/methods/step.hpp"
#include "solvers/models/least_squares.hpp"
#include "solvers/models/weight.hpp"

namespace ridgeloc::solvers {

/// Least squares at an iterate u_k, W = diag(s^2) or diag(s).
template <class Real, std::size_t P>
struct LeastSquares {
  NormalEquations<Real, P> equations;
  core::Vector<Real, P> ols_step = every<P>(Real(0.0));
  core::Mask<Real> singular = none<Real>();
};

/// Gauss-Newton from u_k - dx_ls to its end, by the solver's own stop rule: u_k minus where it ends. A lane whose
/// normal matrix becomes singular stays where it is.
template <class Model, class Real = typename Model::Real>
typename Model::Vector full_least_squares(const SolverOptions& options, const Model& model,
                                          const typename Model::Vector& u,
                                          const LeastSquares<Real, Model::unknowns>& first) {
  const ScoreWeights scores(options);
  const Real tolerance(options.step_tolerance_m * options.step_tolerance_m);
  typename Model::Vector at = core::subtract(u, first.ols_step);
  core::Mask<Real> going = (!first.singular) & (tolerance <= model.squared_move(first.ols_step));
  for (int i = 1; i < options.max_iterations && core::any(going); ++i) {
    const auto equations = normal_equations(model, at, scores);
    const auto solution = core::solve(equations.matrix, equations.gradient, model.observations());
    const Real move = model.squared_move(solution.x);
    going = going & (!solution.singular) & core::is_finite(move);
    at = core::select<Real>(going, core::subtract(at, solution.x), at);
    going = going & (tolerance <= move);
  }
  return core::subtract(u, at);
}

/// The robust weights of rrr with all options: made from residuals at another place, scaled to a mean of 1.
template <class Model>
struct RidgeWeights {
  using Real = typename Model::Real;
  using Vector = typename Model::Vector;

  PaperWeights paper;
  const Model& model;
  bool elsewhere;
  Vector place;
  Real factor{1.0};
  bool normalized = false;

  RidgeWeights(const SolverOptions& options, const Model& of, const Vector& u, const Vector& ols_step)
      : paper(options, of.points(), Model::unknowns),
        model(of),
        elsewhere(options.irls_residual == IrlsResidual::Ols),
        place(elsewhere ? core::subtract(u, ols_step) : u) {
    if (options.normalize_weights == NormalizeWeights::Off) return;
    Real sum(0.0);
    for_each_point(model, [&](auto j, const auto&) { sum = sum + paper(j, model.score(j), model.residual(j, place)); });
    factor = Real(static_cast<double>(model.points())) * core::reciprocal(sum);
    normalized = true;
  }

  template <class Score>
  Real operator()(std::size_t j, const Score& score, const Real& residual) const {
    return factor * paper(j, score, elsewhere ? model.residual(j, place) : residual);
  }

  /// What an observation with a small residual weighs.
  double largest() const { return normalized ? 1.0 : paper.largest(); }
};

}  // namespace ridgeloc::solvers
