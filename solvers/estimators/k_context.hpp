#pragma once

#include <cstddef>

#include "core/matrix.hpp"
#include "core/random.hpp"
#include "solvers/models/observation.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// Components of a step or an error smaller than this (m) count as this long, so that none sends k to infinity.
inline constexpr double k_length_floor_m = 1e-9;

/// What a simulation knows about the trials in the lanes: core::Oracle by lane.
template <class Real, std::size_t P>
struct TrialOracle {
  core::Vector<Real, P> truth;  ///< true unknowns
  Real range_variance;          ///< of the noise (m^2)
  core::Stream k_error;         ///< directions of the error of a perturbed K
  core::Words<Real> trial;      ///< number of the trial in the study
};

/// What an estimator of the ridge parameter may use at one iteration: the least-squares problem at u_k and its
/// solution. With p unknowns; lengths are those of the unknowns.
template <class Real, std::size_t P>
struct KContext {
  NormalEquations<Real, P> least_squares;  ///< at u_k (only where `needs_ols_step`, and so are the next five)
  core::Vector<Real, P> ols_step;          ///< dx_ls: the least-squares step at u_k
  Real squares;                            ///< e'We at u_k, with what is known of v (only where `needs_squares`)
  Real sigma2;                             ///< variance of a residual of weight 1, as options.sigma2_source says
  core::Vector<Real, P> alpha;             ///< dx_ls in the coordinates of K: the unknowns', or Q'dx_ls
  core::Vector<Real, P> eigenvalues;       ///< of J'WJ = Q diag(l) Q', where K is in canonical coordinates
  core::Vector<Real, P> u;                 ///< iterate u_k
  Real iteration;                          ///< steps taken before this one: differs between lanes
  std::size_t observations;                ///< points, and one more where something is known of v
  const TrialOracle<Real, P>* oracle;
  const SolverOptions& options;
};

/// What most estimators of K have in common: they learn from the least-squares step, know no truth, take alpha in the
/// coordinates that the options say, and give one k for all components.
struct KDefaults {
  static constexpr bool needs_ols_step = true;
  static constexpr bool needs_oracle = false;
  static constexpr bool needs_eigenvalues = false;  ///< is always in canonical coordinates
  static constexpr bool needs_squares = false;
  static constexpr bool is_scalar = true;
};

/// What an estimator asks for and gives, where it may depend on the options.
struct KTraits {
  bool needs_ols_step;
  bool needs_squares;
  bool needs_eigenvalues;
  bool is_scalar;
};

/// alpha_i^2, floored.
template <class Real, std::size_t P>
core::Vector<Real, P> squared_alpha(const KContext<Real, P>& c) {
  return core::make_vector<P>([&](auto i) {
    const Real length = core::max(core::abs(c.alpha[i]), Real(k_length_floor_m));
    return length * length;
  });
}

template <class Real, std::size_t P>
Real largest(const core::Vector<Real, P>& values) {
  Real most = values[0];
  core::unroll<P - 1>([&](auto i) { most = core::max(most, values[i + 1]); });
  return most;
}

template <class Real, std::size_t P>
Real sum(const core::Vector<Real, P>& values) {
  Real total = values[0];
  core::unroll<P - 1>([&](auto i) { total = total + values[i + 1]; });
  return total;
}

/// The median, of an even number the mean of the middle two.
template <class Real, std::size_t P>
Real median_of(core::Vector<Real, P> values) {
  // Bubble sort: fewer than four unknowns need no better.
  core::unroll<P - 1>([&](auto pass) {
    core::unroll<P - 1 - pass>([&](auto i) {
      const core::Mask<Real> ordered = values[i] < values[i + 1];
      const Real low = core::select(ordered, values[i], values[i + 1]);
      values[i + 1] = core::select(ordered, values[i + 1], values[i]);
      values[i] = low;
    });
  });
  if constexpr (P % 2 == 1) {
    return values[P / 2];
  } else {
    return Real(0.5) * (values[P / 2 - 1] + values[P / 2]);
  }
}

/// The same k in every component.
template <std::size_t P, class Real>
core::Vector<Real, P> every(const Real& k) {
  return core::make_vector<P>([&](auto) { return k; });
}

}  // namespace ridgeloc::solvers
