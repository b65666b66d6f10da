#pragma once

#include <cmath>
#include <cstddef>
#include <span>

#include "bench/problem_set.hpp"

namespace ridgeloc::bench {

/// How a library lays out the n x 3 Jacobian.
enum class Order { RowMajor, ColumnMajor };

/// Residuals e_j = |p_j - x| - m_j and their analytic Jacobian (x - p_j)' / |x - p_j|: the one model that all peers
/// minimise. Either pointer may be null. It is a header so that a peer with a fixed number of points, which passes a
/// span of constant size, gets an unrolled loop.
template <Order order>
inline void evaluate(std::span<const Observation> observations, const double* x, double* residuals, double* jacobian) {
  const std::size_t points = observations.size();
  const double position[3] = {x[0], x[1], x[2]};
  for (std::size_t j = 0; j < points; ++j) {
    const auto& [point, measured] = observations[j];
    const double d[3] = {position[0] - point[0], position[1] - point[1], position[2] - point[2]};
    const double range = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (residuals != nullptr) residuals[j] = range - measured;
    if (jacobian != nullptr) {
      const double inverse = 1.0 / range;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        jacobian[order == Order::RowMajor ? j * 3 + axis : axis * points + j] = d[axis] * inverse;
      }
    }
  }
}

}  // namespace ridgeloc::bench
