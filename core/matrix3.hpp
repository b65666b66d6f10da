#pragma once

#include <array>
#include <limits>

#include "core/real.hpp"

/// Three unknowns' worth of linear algebra over `Real`: small enough that the explicit inverse is both the fastest and,
/// since it needs no pivoting, the only form that treats indefinite matrices and all lanes alike.
namespace ridgeloc::core {

template <class Real>
using Vector3 = std::array<Real, 3>;

template <class Real>
Real dot(const Vector3<Real>& a, const Vector3<Real>& b) {
  return mul_add(a[2], b[2], mul_add(a[1], b[1], a[0] * b[0]));
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

/// The adjugate of A and det A, which together are its inverse. `singular` where |det A| <= 3 eps |A|^3, with |A|^3
/// read as the product of the row norms: Hadamard's bound on |det A|. Scaling a row scales both sides, so that a ridge
/// of 10^16 in one component, which makes a matrix no harder to solve, does not make it singular.
template <class Real>
struct Adjugate {
  Symmetric3<Real> matrix;
  Real determinant;
  Mask<Real> singular;
};

template <class Real>
Adjugate<Real> adjugate(const Symmetric3<Real>& a) {
  const Symmetric3<Real> c = {neg_mul_add(a.yz, a.yz, a.yy * a.zz), neg_mul_add(a.xy, a.zz, a.xz * a.yz),
                              neg_mul_add(a.xz, a.yy, a.xy * a.yz), neg_mul_add(a.xz, a.xz, a.xx * a.zz),
                              neg_mul_add(a.xx, a.yz, a.xy * a.xz), neg_mul_add(a.xy, a.xy, a.xx * a.yy)};
  const Real determinant = dot<Real>({a.xx, a.xy, a.xz}, {c.xx, c.xy, c.xz});

  const Real xy_squared = a.xy * a.xy;
  const Real xz_squared = a.xz * a.xz;
  const Real yz_squared = a.yz * a.yz;
  const Real row_x = mul_add(a.xx, a.xx, xy_squared + xz_squared);
  const Real row_y = mul_add(a.yy, a.yy, xy_squared + yz_squared);
  const Real row_z = mul_add(a.zz, a.zz, xz_squared + yz_squared);
  constexpr double threshold = 3.0 * std::numeric_limits<double>::epsilon();
  const Real bound = Real(threshold * threshold) * row_x * row_y * row_z;
  return {c, determinant, determinant * determinant <= bound};
}

template <class Real>
struct LinearSolution {
  Vector3<Real> x;
  Mask<Real> singular;
};

/// x = A^-1 b by the adjugate. Where A is not finite, x is not finite and `singular` is false.
template <class Real>
LinearSolution<Real> solve(const Symmetric3<Real>& a, const Vector3<Real>& b) {
  const Adjugate<Real> c = adjugate(a);
  const Real inverse = reciprocal(c.determinant);
  return {{dot<Real>({c.matrix.xx, c.matrix.xy, c.matrix.xz}, b) * inverse,
           dot<Real>({c.matrix.xy, c.matrix.yy, c.matrix.yz}, b) * inverse,
           dot<Real>({c.matrix.xz, c.matrix.yz, c.matrix.zz}, b) * inverse},
          c.singular};
}

}  // namespace ridgeloc::core
