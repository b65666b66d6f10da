#include "studies/measured/covariance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/symmetric_eigen.hpp"

namespace ridgeloc::studies {

namespace {

using Matrix = core::Symmetric<double, 3>;

/// The inverse, or nothing of a matrix that is singular to rounding. An unknown that is known has a zero row in both.
std::optional<Matrix> inverse_of(Matrix a, bool knows_height) {
  constexpr double rounding = 1e-14;
  if (knows_height) a(2, 2) = a(0, 0) + a(1, 1);
  const auto eigen = core::symmetric_eigen(a);
  const auto [least, most] = std::ranges::minmax(eigen.values);
  if (!(least > rounding * most)) return std::nullopt;
  Matrix inverse;
  for (std::size_t v = 0; v < 3; ++v)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = i; k < 3; ++k) inverse(i, k) += eigen.vectors[v][i] * eigen.vectors[v][k] / eigen.values[v];
  if (knows_height) inverse(2, 2) = 0.0;
  return inverse;
}

/// A B A.
Covariance sandwich(const Matrix& a, const Matrix& b) {
  Covariance out{};
  std::size_t at = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = i; k < 3; ++k, ++at)
      for (std::size_t r = 0; r < 3; ++r)
        for (std::size_t s = 0; s < 3; ++s) out[at] += a(i, r) * b(r, s) * a(s, k);
  return out;
}

}  // namespace

Uncertainty uncertainty_of(const Epoch& epoch, const Place& position, std::span<const double> weights,
                           std::span<const double> residuals, bool knows_height, std::optional<double> sigma_m) {
  Matrix plain;
  Matrix weighted;
  Matrix squared;
  double squares = 0.0;
  double weighted_squares = 0.0;
  for (std::size_t j = 0; j < epoch.readings.size(); ++j) {
    Place direction{};
    double length = 0.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      direction[axis] = position[axis] - epoch.readings[j].at[axis];
      length += direction[axis] * direction[axis];
    }
    if (knows_height) direction[2] = 0.0;
    const double weight = weights[j];
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = i; k < 3; ++k) {
        const double product = direction[i] * direction[k] / length;
        plain(i, k) += product;
        weighted(i, k) += weight * product;
        squared(i, k) += weight * weight * product;
      }
    }
    squares += residuals[j] * residuals[j];
    weighted_squares += weight * weight * residuals[j] * residuals[j];
  }
  Uncertainty out;
  const auto of_plain = inverse_of(plain, knows_height);
  out.gdop = of_plain ? std::sqrt((*of_plain)(0, 0) + (*of_plain)(1, 1) + (*of_plain)(2, 2))
                      : std::numeric_limits<double>::infinity();
  const std::size_t unknowns = knows_height ? 2 : 3;
  out.sigma_m = sigma_m;
  const bool has_more = residuals.size() > unknowns;
  const double left_over = has_more ? static_cast<double>(residuals.size() - unknowns) : 0.0;
  if (!sigma_m && has_more) out.sigma_m = std::sqrt(squares / left_over);
  const auto of_weighted = inverse_of(weighted, knows_height);
  if (!out.sigma_m || !of_weighted) return out;
  Covariance covariance = sandwich(*of_weighted, sigma_m ? squared : plain);
  for (double& entry : covariance) entry *= sigma_m ? *sigma_m * *sigma_m : weighted_squares / left_over;
  out.covariance = covariance;
  return out;
}

}  // namespace ridgeloc::studies
