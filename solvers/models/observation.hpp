#pragma once

#include <cstddef>

#include "core/matrix.hpp"

/// What is measured, as functions of the unknowns, over `Real`. A `Model` speaks for the trials in the lanes:
///   unknowns, positions            how many unknowns there are, and how many of the first are coordinates
///   fixed_points, points(), score(j)
///   start(), given(position, v)    the unknowns of the start; of a position and image distance
///   observe(j, u)                  residual and row of the Jacobian
///   residual(j, u), residual_change(j, u, du)
///   position(u), image_distance(u) back to metres and millimetres
///   squared_move(du)               |step of the position|^2 (m^2)
///   always_in_domain, in_domain(u) where residuals are defined
///   lifted(j), lifted_size(j), unlifted(y), possible(y)  the squared equation, linear in y: see
///   solvers/methods/closed_form.hpp
///   add_prior(u, factor, equations), prior_change(u, du), prior_squares(u)  what is known of v, as one more
///   observation observations()                 how many there are with that
namespace ridgeloc::solvers {

/// A number of points that is known only when the program runs.
inline constexpr std::size_t any_points = 0;

/// Calls f(j, model, arguments...) for every point; without a loop where their number is known when the program is
/// compiled. What f is given stays in registers, what it captures may not.
template <class Model, class F, class... Arguments>
[[gnu::always_inline]] inline void for_each_point(const Model& model, const F& f, Arguments&&... arguments) {
  if constexpr (Model::fixed_points != any_points) {
    core::unroll<Model::fixed_points>(f, model, arguments...);
  } else {
    for (std::size_t j = 0; j < model.points(); ++j) f(j, model, arguments...);
  }
}

/// One observation, linearised.
template <class Real, std::size_t P>
struct Observation {
  core::Vector<Real, P> row;  ///< of the Jacobian: de/du
  Real residual;              ///< e (m)
};

/// A residual and how much the step u <- u - du changes it.
template <class Real>
struct ResidualChange {
  Real residual;
  Real change;
};

/// The score of every observation of a problem without scores. Multiplying by it costs nothing.
struct UnitScore {
  friend constexpr UnitScore operator*(UnitScore, UnitScore) { return {}; }
  template <class Real>
  friend const Real& operator*(UnitScore, const Real& x) {
    return x;
  }
};

/// Normal equations of a weighted linear least-squares step: matrix J'WJ, gradient J'We.
template <class Real, std::size_t P>
struct NormalEquations {
  core::Symmetric<Real, P> matrix;
  core::Vector<Real, P> gradient = core::make_vector<P>([](auto) { return Real(0.0); });

  template <class Weight>
  [[gnu::always_inline]] void add(const Observation<Real, P>& o, const Weight& weight) {
    core::unroll<P>(
        [](auto i, auto& m, auto& g, const auto& observed, const auto& w) __attribute__((always_inline)) {
          const Real weighted = w * observed.row[i];
          core::unroll<P - i>(
              [](auto offset, auto k, auto& n, const auto& row, const Real& a) __attribute__((always_inline)) {
                n(k, k + offset) = core::mul_add(a, row[k + offset], n(k, k + offset));
              },
              i, m, observed.row, weighted);
          g[i] = core::mul_add(weighted, observed.residual, g[i]);
        },
        matrix, gradient, o, weight);
  }
};

}  // namespace ridgeloc::solvers
