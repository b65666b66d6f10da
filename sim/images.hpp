#pragma once

#include <cstddef>
#include <span>

#include "core/matrix.hpp"
#include "core/problem.hpp"
#include "core/real.hpp"
#include "sim/field_of_view.hpp"

namespace ridgeloc::sim {

/// Turns measured ranges into what a photo says: pseudoranges and their factors (RRR paper, eq. 1, Fig. 2).
///
/// A point at range r and depth u along the optical axis (+x) appears l = v sqrt(r^2 - u^2) / u from the centre, v the
/// image distance, and its size gives alpha = (u / v)^2, so that r^2 = alpha v^2 + alpha l^2. A measured range m in
/// place of r, the wrong size of its box, makes alpha = (u / v)^2 (m / r)^2 and rho = alpha l^2.
///
/// The lens is focused on the first point: v = f u_0 / (u_0 - f), but no nearer than 2 f. Solvers start from v = f.
/// Precondition: points lie before the camera; `problems` has room for images. Writes the true v (mm).
template <class Real = double>
[[gnu::flatten]] void take_images(double focal_length_mm, core::ProblemBatch& problems,
                                  std::span<double> image_distance_mm) {
  constexpr double mm_per_m = 1000.0;
  const Real f(focal_length_mm);
  for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
    const auto from_camera = [&](std::size_t j) {
      core::Vector3<Real> d;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        d[axis] = core::load_column<Real>(problems.position(j, axis), slot) - Real(true_position_m[axis]);
      }
      return d;
    };
    const Real focus = core::max(Real(mm_per_m) * from_camera(0)[0], f + f);
    const Real v = f * focus * core::reciprocal(focus - f);
    core::store_column(image_distance_mm, slot, v);
    core::store_column(problems.start_image_distance(), slot, f);
    for (std::size_t j = 0; j < problems.points(); ++j) {
      const core::Vector3<Real> d = from_camera(j);
      const Real squared_range = core::dot(d, d);
      const Real measured = core::load_column<Real>(problems.measured(j), slot);
      const Real stretch = measured * measured * core::reciprocal(squared_range);
      const Real per_distance = d[0] * core::reciprocal(v);
      core::store_column(problems.alpha(j), slot, stretch * per_distance * per_distance);
      core::store_column(problems.measured(j), slot, stretch * core::neg_mul_add(d[0], d[0], squared_range));
    }
  }
}

}  // namespace ridgeloc::sim
