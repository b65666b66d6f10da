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

namespace detail {

/// Rotates in the plane (p, q) so that a_pq becomes zero, where it is not negligible; returns where.
template <std::size_t p, std::size_t q, class Real, std::size_t P>
[[gnu::always_inline]] inline Mask<Real> rotate(Symmetric<Real, P>& a, std::array<Vector<Real, P>, P>& vectors) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const Real zero(0.0);
  const Real off = a(p, q);
  // What is not a number needs a rotation too, and spreads: alone as in company.
  const Mask<Real> needed = !(off * off <= Real(epsilon * epsilon) * abs(a(p, p) * a(q, q)));
  if (!any(needed)) return needed;

  // t = sign(theta) / (|theta| + sqrt(theta^2 + 1)), theta = (a_qq - a_pp) / (2 a_pq), as one fraction. Elsewhere t =
  // 0, which changes nothing.
  const Real half_gap = Real(0.5) * (a(q, q) - a(p, p));
  const Real length = abs(half_gap) + sqrt(mul_add(off, off, half_gap * half_gap));
  const Real t = select(needed, select(half_gap < zero, -off, off) * reciprocal(length), zero);
  const Real c = root_and_inverse(mul_add(t, t, Real(1.0))).inverse;
  const Real s = t * c;
  a(p, p) = neg_mul_add(t, off, a(p, p));
  a(q, q) = mul_add(t, off, a(q, q));
  a(p, q) = select(needed, zero, off);
  const auto turn = [](const Real& cosine, const Real& sine, Real& to_p, Real& to_q) __attribute__((always_inline)) {
    const Real before = to_p;
    to_p = neg_mul_add(sine, to_q, cosine * before);
    to_q = mul_add(sine, before, cosine * to_q);
  };
  unroll<P>(
      [](auto k, const auto& f, const Real& cosine, const Real& sine, auto& matrix, auto& columns)
          __attribute__((always_inline)) {
            if constexpr (k != p && k != q) f(cosine, sine, matrix(k, p), matrix(k, q));
            f(cosine, sine, columns[p][k], columns[q][k]);
          },
      turn, c, s, a, vectors);
  return needed;
}

}  // namespace detail

/// Eigenvalues and eigenvectors by Jacobi's method: rotations in the planes (0, 1), (0, 2), ... in turn, each of which
/// brings one element to zero, until every |a_ij| <= eps sqrt(|a_ii a_jj|). Positive definite matrices come out to high
/// relative accuracy, small eigenvalues included (Demmel and Veselic 1992). Lanes that are done rotate by nothing, so
/// that a lane does not depend on the others; matrices that are not finite end after `most_sweeps`. Large, so never
/// inlined.
template <class Real, std::size_t P>
[[gnu::noinline]] SymmetricEigen<Real, P> symmetric_eigen(Symmetric<Real, P> a) {
  constexpr int most_sweeps = 12;
  SymmetricEigen<Real, P> out;
  out.vectors = make_vector<P>([](auto i) { return make_vector<P>([i](auto j) { return Real(i == j ? 1.0 : 0.0); }); });
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    Mask<Real> rotated = Real(1.0) < Real(0.0);
    unroll<P - 1>(
        [](auto p, auto& matrix, auto& vectors, auto& any_plane) __attribute__((always_inline)) {
          unroll<P - 1 - p>(
              [](auto m, auto r, auto& x, auto& v, auto& all)
                  __attribute__((always_inline)) { all = all | detail::rotate<r, r + 1 + m>(x, v); },
              p, matrix, vectors, any_plane);
        },
        a, out.vectors, rotated);
    if (!any(rotated)) break;
  }
  out.values = diagonal(a);
  return out;
}

}  // namespace ridgeloc::core
