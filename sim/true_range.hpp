#pragma once

#include <cstddef>

#include "core/matrix.hpp"
#include "core/problem.hpp"
#include "core/real.hpp"
#include "sim/field_of_view.hpp"

namespace ridgeloc::sim {

/// Distance (m) of point j from the true position, in the trials from `slot` on.
template <class Real>
Real true_range(const core::ProblemBatch& problems, std::size_t j, std::size_t slot) {
  core::Vector3<Real> d;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    d[axis] = core::load_column<Real>(problems.position(j, axis), slot) - Real(true_position_m[axis]);
  }
  return core::sqrt(core::dot(d, d));
}

}  // namespace ridgeloc::sim
