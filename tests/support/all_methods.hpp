#pragma once

#include <string>
#include <vector>

#include "solvers/solver.hpp"

namespace ridgeloc::tests {

/// A solver with options of one kind.
struct MethodChoice {
  const solvers::SolverEntry* entry;
  solvers::SolverOptions options;
  std::string name;
};

/// Every solver with every estimator of K that it can have, other options at their defaults.
std::vector<MethodChoice> methods_by_k();

/// Every other option of every solver, one value at a time, where it is not the default: variants of lm, weights of
/// irls, starts, scores, canonical coordinates with every estimator, and what else a ridge can be given.
std::vector<MethodChoice> methods_by_option();

/// What pseudoranges can be asked for besides the default: z and v known or not, scaling, residual.
struct ModelChoice {
  solvers::ZMode z_mode;
  solvers::VMode v_mode;
  solvers::ColumnScale column_scale;
  solvers::Residual residual;
  solvers::Jacobian jacobian;
};
std::vector<ModelChoice> pseudorange_models();
void apply(const ModelChoice& model, solvers::SolverOptions& options);
std::string name_of(const ModelChoice& model);

}  // namespace ridgeloc::tests
