#pragma once

#include <array>
#include <span>

#include "core/problem.hpp"

namespace ridgeloc::studies {

/// Normalized estimation error squared of least squares from ranges, d'P^-1 d with the error d = x - truth (m) and P =
/// sigma^2 (J'J)^-1, what least squares says of its own covariance, J at the estimate x: with the unit vectors u_j from
/// the estimate to the objects, sum_j (u_j'd)^2 / sigma^2. Chi-square with three degrees of freedom, in expectation 3,
/// as long as the problem is linear over its own error; larger where estimates are worse than they claim.
///
/// One value per trial of `problems`, into `nees`; NaN where an estimate lies on an object or sigma is 0.
void normalized_squared_errors(const core::ProblemBatch& problems,
                               const std::array<std::span<const double>, core::position_parameters>& estimate,
                               const std::array<std::span<const double>, core::position_parameters>& truth_m,
                               double sigma_m, std::span<double> nees);

}  // namespace ridgeloc::studies
