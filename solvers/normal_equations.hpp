#pragma once

#include "core/matrix3.hpp"
#include "solvers/range_model.hpp"

namespace ridgeloc::solvers {

/// Normal equations of a weighted linear least-squares step: matrix J'WJ, gradient J'We.
template <class Real>
struct NormalEquations {
  core::Symmetric3<Real> matrix;
  core::Vector3<Real> gradient{Real(0.0), Real(0.0), Real(0.0)};

  template <class Weight>
  void add(const RangeObservation<Real>& o, const Weight& weight) {
    using core::mul_add;
    const Real wx = weight * o.direction[0];
    const Real wy = weight * o.direction[1];
    const Real wz = weight * o.direction[2];
    matrix.xx = mul_add(wx, o.direction[0], matrix.xx);
    matrix.xy = mul_add(wx, o.direction[1], matrix.xy);
    matrix.xz = mul_add(wx, o.direction[2], matrix.xz);
    matrix.yy = mul_add(wy, o.direction[1], matrix.yy);
    matrix.yz = mul_add(wy, o.direction[2], matrix.yz);
    matrix.zz = mul_add(wz, o.direction[2], matrix.zz);
    gradient[0] = mul_add(wx, o.residual, gradient[0]);
    gradient[1] = mul_add(wy, o.residual, gradient[1]);
    gradient[2] = mul_add(wz, o.residual, gradient[2]);
  }
};

}  // namespace ridgeloc::solvers
