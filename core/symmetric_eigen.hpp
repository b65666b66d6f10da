#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "core/matrix.hpp"

namespace ridgeloc::core {

/// A = Q diag(values) Q'. The eigenvalues are in no particular order.
template <class Real, std::size_t P>
struct SymmetricEigen {
  Vector<Real, P> values;
  std::array<Vector<Real, P>, P> vectors;  ///< vectors[i] belongs to values[i]: column i of Q
};

/// Eigenvalues and eigenvectors by Jacobi's method: rotations in the planes (0, 1), (0, 2), ... in turn, each of which
/// brings one element to zero, until every |a_ij| <= eps sqrt(|a_ii a_jj|). Positive definite matrices come out to high
/// relative accuracy, small eigenvalues included (Demmel and Veselic 1992). Lanes that are done rotate by nothing, so
/// that a lane does not depend on the others; matrices that are not finite end after `most_sweeps`.
template <class Real, std::size_t P>
SymmetricEigen<Real, P> symmetric_eigen(Symmetric<Real, P> a) {
  constexpr int most_sweeps = 12;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const Real zero(0.0);
  const Real one(1.0);
  SymmetricEigen<Real, P> out;
  out.vectors = make_vector<P>([&](auto i) { return make_vector<P>([&](auto j) { return i == j ? one : zero; }); });
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    Mask<Real> rotated = one < zero;
    unroll<P - 1>([&](auto p) {
      unroll<P - 1 - p>([&](auto m) {
        constexpr std::size_t q = p + 1 + m;
        const Real off = a(p, q);
        const Mask<Real> rotate = off * off > Real(epsilon * epsilon) * abs(a(p, p) * a(q, q));
        // t = sign(theta) / (|theta| + sqrt(theta^2 + 1)), theta = (a_qq - a_pp) / (2 a_pq), as one fraction.
        const Real half_gap = Real(0.5) * (a(q, q) - a(p, p));
        const Real length = abs(half_gap) + sqrt(mul_add(off, off, half_gap * half_gap));
        const Real t = select(rotate, select(half_gap < zero, -off, off) * reciprocal(length), zero);
        const Real c = root_and_inverse(mul_add(t, t, one)).inverse;
        const Real s = t * c;
        a(p, p) = neg_mul_add(t, off, a(p, p));
        a(q, q) = mul_add(t, off, a(q, q));
        a(p, q) = select(rotate, zero, off);
        unroll<P>([&](auto k) {
          if constexpr (k != p && k != q) {
            const Real to_p = neg_mul_add(s, a(k, q), c * a(k, p));
            a(k, q) = mul_add(s, a(k, p), c * a(k, q));
            a(k, p) = to_p;
          }
          const Real to_p = neg_mul_add(s, out.vectors[q][k], c * out.vectors[p][k]);
          out.vectors[q][k] = mul_add(s, out.vectors[p][k], c * out.vectors[q][k]);
          out.vectors[p][k] = to_p;
        });
        rotated = rotated | rotate;
      });
    });
    if (!any(rotated)) break;
  }
  out.values = make_vector<P>([&](auto i) { return a(i, i); });
  return out;
}

}  // namespace ridgeloc::core
