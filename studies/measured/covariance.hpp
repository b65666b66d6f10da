#pragma once

#include <array>
#include <optional>
#include <span>

#include "studies/measured/epoch.hpp"

namespace ridgeloc::studies {

/// A symmetric matrix of the position: xx, xy, xz, yy, yz, zz.
using Covariance = std::array<double, 6>;

/// What the readings say about the uncertainty of a position that was solved from them.
struct Uncertainty {
  double gdop = 0.0;                     ///< sqrt(tr (J'J)^-1), infinite where J'J is singular
  std::optional<double> sigma_m;         ///< standard deviation of a range
  std::optional<Covariance> covariance;  ///< m^2; nothing without sigma, or where J'WJ is singular
};

/// The sandwich covariance at the estimate x, with the rows u_j = (x - p_j) / |x - p_j| of J. With a given sigma
///
///     P = sigma^2 (J'WJ)^-1 (J'W^2 J) (J'WJ)^-1,
///
/// and otherwise, from more readings than unknowns, what the weighted residuals say, which weights keep outliers out
/// of:
///
///     P = (e'W^2 e / (n - p)) (J'WJ)^-1 (J'J) (J'WJ)^-1.
///
/// Neither changes with the scale of the weights; both are sigma^2 (J'J)^-1 where all weights are 1. `sigma_m` is as
/// given, or sqrt(e'e / (n - p)). A ridge damps the way to the estimate and not the place where it ends, so that K is
/// not in it. Where the height is known p is 2, and its rows and columns are zero.
Uncertainty uncertainty_of(const Epoch& epoch, const Place& position, std::span<const double> weights,
                           std::span<const double> residuals, bool knows_height, std::optional<double> sigma_m);

}  // namespace ridgeloc::studies
