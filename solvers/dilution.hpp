#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include "core/matrix.hpp"
#include "core/problem.hpp"
#include "solvers/observation.hpp"
#include "solvers/range_model.hpp"

namespace ridgeloc::solvers {

/// Geometric dilution of precision of every problem at one position, the true one: sqrt(tr (J'J)^-1), infinite where
/// J'J is singular. The Cramer-Rao bound of the position is range sigma times this, sqrt(tr F^-1) with F = J'J /
/// sigma^2.
template <class Real = double>
[[gnu::flatten]] void dilution_of_precision(const core::ProblemBatch& problems, const std::array<double, 3>& truth,
                                            std::span<double> gdop) {
  const SolverOptions options;
  const core::Vector3<Real> x = {Real(truth[0]), Real(truth[1]), Real(truth[2])};
  for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
    const RangeModel<Real> model(problems, slot, options);
    NormalEquations<Real, 3> unweighted;
    for_each_point(model, [&](auto j, const auto&) { unweighted.add(model.observe(j, x), Real(1.0)); });
    const core::Adjugate<Real> inverse = core::adjugate(unweighted.matrix);
    const Real trace =
        (inverse.matrix(0, 0) + inverse.matrix(1, 1) + inverse.matrix(2, 2)) * core::reciprocal(inverse.determinant);
    // Near singularity rounding can turn the trace of a positive definite inverse negative.
    const core::Mask<Real> regular = (!inverse.singular) & (trace > Real(0.0));
    const Real infinite(std::numeric_limits<double>::infinity());
    core::store_column(gdop, slot, core::select(regular, core::sqrt(core::max(trace, Real(0.0))), infinite));
  }
}

}  // namespace ridgeloc::solvers
