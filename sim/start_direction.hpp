#pragma once

#include <array>

#include "core/random.hpp"

namespace ridgeloc::sim {

/// In which direction the start lies from the truth, from two uniforms: uniform on the sphere, or among those that keep
/// the height.
template <class Real>
std::array<Real, 3> start_direction(bool at_height, const std::array<Real, 2>& u) {
  if (!at_height) return core::unit_vector(u);
  const core::SinCos<Real> angle = core::sin_cos_turns(u[1]);
  return {angle.cos, angle.sin, Real(0.0)};
}

}  // namespace ridgeloc::sim
