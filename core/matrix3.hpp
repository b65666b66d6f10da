#pragma once

#include <array>

#include "core/real.hpp"

/// Three unknowns' worth of linear algebra over `Real`: small enough that the explicit inverse is both the fastest and,
/// since it needs no pivoting, the only form that treats indefinite matrices and all lanes alike.
namespace ridgeloc::core {

template <class Real>
using Vector3 = std::array<Real, 3>;

template <class Real>
Real dot(const Vector3<Real>& a, const Vector3<Real>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

template <class Real>
Vector3<Real> subtract(const Vector3<Real>& a, const Vector3<Real>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

template <class Real>
Vector3<Real> select(const Mask<Real>& mask, const Vector3<Real>& a, const Vector3<Real>& b) {
  return {select(mask, a[0], b[0]), select(mask, a[1], b[1]), select(mask, a[2], b[2])};
}

/// A symmetric 3 x 3 matrix.
template <class Real>
struct Symmetric3 {
  Real xx{0.0}, xy{0.0}, xz{0.0}, yy{0.0}, yz{0.0}, zz{0.0};
};

template <class Real>
Symmetric3<Real> add_diagonal(Symmetric3<Real> a, const Vector3<Real>& d) {
  a.xx = a.xx + d[0];
  a.yy = a.yy + d[1];
  a.zz = a.zz + d[2];
  return a;
}

template <class Real>
struct LinearSolution {
  Vector3<Real> x;
  Mask<Real> singular;
};

/// x = A^-1 b by the adjugate. `singular` where |det A| <= 3 eps |A|^3, with |A|^3 read as the product of the row
/// norms: Hadamard's bound on |det A|. Scaling a row scales both sides, so that a ridge of 10^16 in one component,
/// which makes a matrix no harder to solve, does not make it singular. Where A is not finite, x is not finite and
/// `singular` is false.
template <class Real>
LinearSolution<Real> solve(const Symmetric3<Real>& a, const Vector3<Real>& b) {
  const Real c_xx = a.yy * a.zz - a.yz * a.yz;
  const Real c_xy = a.xz * a.yz - a.xy * a.zz;
  const Real c_xz = a.xy * a.yz - a.xz * a.yy;
  const Real c_yy = a.xx * a.zz - a.xz * a.xz;
  const Real c_yz = a.xy * a.xz - a.xx * a.yz;
  const Real c_zz = a.xx * a.yy - a.xy * a.xy;
  const Real determinant = a.xx * c_xx + a.xy * c_xy + a.xz * c_xz;

  const Real row_x = a.xx * a.xx + a.xy * a.xy + a.xz * a.xz;
  const Real row_y = a.xy * a.xy + a.yy * a.yy + a.yz * a.yz;
  const Real row_z = a.xz * a.xz + a.yz * a.yz + a.zz * a.zz;
  constexpr double threshold = 3.0 * std::numeric_limits<double>::epsilon();
  const Real bound = Real(threshold * threshold) * row_x * row_y * row_z;

  const Real inverse = Real(1.0) / determinant;
  return {{(c_xx * b[0] + c_xy * b[1] + c_xz * b[2]) * inverse, (c_xy * b[0] + c_yy * b[1] + c_yz * b[2]) * inverse,
           (c_xz * b[0] + c_yz * b[1] + c_zz * b[2]) * inverse},
          determinant * determinant <= bound};
}

}  // namespace ridgeloc::core
