#pragma once

#include "core/matrix3.hpp"
#include "solvers/range_model.hpp"

namespace ridgeloc::solvers {

/// Normal equations of a weighted linear least-squares step: matrix J'WJ, gradient J'We.
template <class Real>
struct NormalEquations {
  core::Symmetric3<Real> matrix;
  core::Vector3<Real> gradient{Real(0.0), Real(0.0), Real(0.0)};

  void add(const RangeObservation<Real>& o, Real weight) {
    const Real wx = weight * o.direction[0];
    const Real wy = weight * o.direction[1];
    const Real wz = weight * o.direction[2];
    matrix.xx = matrix.xx + wx * o.direction[0];
    matrix.xy = matrix.xy + wx * o.direction[1];
    matrix.xz = matrix.xz + wx * o.direction[2];
    matrix.yy = matrix.yy + wy * o.direction[1];
    matrix.yz = matrix.yz + wy * o.direction[2];
    matrix.zz = matrix.zz + wz * o.direction[2];
    gradient[0] = gradient[0] + wx * o.residual;
    gradient[1] = gradient[1] + wy * o.residual;
    gradient[2] = gradient[2] + wz * o.residual;
  }
};

}  // namespace ridgeloc::solvers
