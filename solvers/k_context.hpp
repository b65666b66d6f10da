#pragma once

#include "core/matrix3.hpp"
#include "core/random.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// Components of a step or an error smaller than this (m) count as this long, so that none sends k to infinity.
inline constexpr double k_length_floor_m = 1e-9;

/// What a simulation knows about the trials in the lanes: core::Oracle by lane.
template <class Real>
struct TrialOracle {
  core::Vector3<Real> truth;  ///< true position (m)
  Real range_variance;        ///< of the noise (m^2)
  core::Stream k_error;       ///< directions of the error of a perturbed K
  core::Words<Real> trial;    ///< number of the trial in the study
};

/// What an estimator of the ridge parameter may use at one iteration.
template <class Real>
struct KContext {
  core::Vector3<Real> ols_step;  ///< dx_ls: one least-squares step at x_k (only where `needs_ols_step`)
  Real sigma2;                   ///< e_ls' W e_ls / n at x_k - dx_ls
  core::Vector3<Real> x;         ///< iterate x_k
  Real iteration;                ///< steps taken before this one: differs between lanes
  const TrialOracle<Real>* oracle = nullptr;
  const SolverOptions& options;
};

}  // namespace ridgeloc::solvers
