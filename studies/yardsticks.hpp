#pragma once

#include <span>

#include "core/problem.hpp"

namespace ridgeloc::studies {

/// Geometric dilution of precision of every trial at the true position: sqrt(tr (J'J)^-1), infinite where J'J is
/// singular. The Cramer-Rao bound of the position is range sigma times this, sqrt(tr F^-1) with F = J'J / sigma^2.
void dilution_of_precision(const core::ProblemBatch& problems, const std::array<double, 3>& truth,
                           std::span<double> gdop);

}  // namespace ridgeloc::studies
