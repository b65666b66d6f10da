#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <utility>

#include "core/real.hpp"

/// Two to four unknowns' worth of linear algebra over `Real`. Nothing here branches on a value or pivots, so that all
/// lanes are treated alike, and no loop indexes an array: sizes are known when the program is compiled.
namespace ridgeloc::core {

template <class Real, std::size_t P>
using Vector = std::array<Real, P>;
template <class Real>
using Vector3 = Vector<Real, 3>;

namespace detail {

template <class F, std::size_t... I, class... Arguments>
[[gnu::always_inline]] inline void unroll(const F& f, std::index_sequence<I...>, Arguments&&... arguments) {
  (f(std::integral_constant<std::size_t, I>{}, arguments...), ...);
}

template <class F, std::size_t... I, class... Arguments>
[[gnu::always_inline]] inline auto make_vector(const F& f, std::index_sequence<I...>, Arguments&&... arguments) {
  using Real = decltype(f(std::integral_constant<std::size_t, 0>{}, arguments...));
  return Vector<Real, sizeof...(I)>{f(std::integral_constant<std::size_t, I>{}, arguments...)...};
}

}  // namespace detail

/// Calls f(i, arguments...) for i = 0, 1, ..., Count - 1 as constants. Where it counts, f captures nothing: compilers
/// keep what a lambda captures in memory, what it is given in registers.
template <std::size_t Count, class F, class... Arguments>
[[gnu::always_inline]] inline void unroll(const F& f, Arguments&&... arguments) {
  detail::unroll(f, std::make_index_sequence<Count>{}, arguments...);
}

/// (f(0, arguments...), f(1, arguments...), ..., f(P - 1, arguments...)), likewise.
template <std::size_t P, class F, class... Arguments>
[[gnu::always_inline]] inline auto make_vector(const F& f, Arguments&&... arguments) {
  return detail::make_vector(f, std::make_index_sequence<P>{}, arguments...);
}

template <class Real, std::size_t P>
[[gnu::always_inline]] inline Real dot(const Vector<Real, P>& a, const Vector<Real, P>& b) {
  Real sum = a[0] * b[0];
  unroll<P - 1>(
      [](auto i, Real& s, const auto& x, const auto& y)
          __attribute__((always_inline)) { s = mul_add(x[i + 1], y[i + 1], s); },
      sum, a, b);
  return sum;
}

template <class Real, std::size_t P>
[[gnu::always_inline]] inline Vector<Real, P> subtract(const Vector<Real, P>& a, const Vector<Real, P>& b) {
  return make_vector<P>(
      [](auto i, const auto& x, const auto& y) __attribute__((always_inline)) { return x[i] - y[i]; }, a, b);
}

template <class Real, std::size_t P>
[[gnu::always_inline]] inline Vector<Real, P> scale(const Real& factor, const Vector<Real, P>& a) {
  return make_vector<P>(
      [](auto i, const Real& f, const auto& x) __attribute__((always_inline)) { return f * x[i]; }, factor, a);
}

template <class Real, std::size_t P>
[[gnu::always_inline]] inline Vector<Real, P> select(const Mask<Real>& mask, const Vector<Real, P>& a,
                                                     const Vector<Real, P>& b) {
  return make_vector<P>(
      [](auto i, const auto& m, const auto& x, const auto& y)
          __attribute__((always_inline)) { return select(m, x[i], y[i]); },
      mask, a, b);
}

/// A symmetric P x P matrix by its upper triangle, row after row.
template <class Real, std::size_t P>
struct Symmetric {
  static constexpr std::size_t size = P * (P + 1) / 2;
  std::array<Real, size> upper = make_vector<size>([](auto) { return Real(0.0); });

  static constexpr std::size_t index(std::size_t i, std::size_t j) {
    return i <= j ? i * P - i * (i + 1) / 2 + j : index(j, i);
  }
  Real& operator()(std::size_t i, std::size_t j) { return upper[index(i, j)]; }
  const Real& operator()(std::size_t i, std::size_t j) const { return upper[index(i, j)]; }
};

template <class Real, std::size_t P>
[[gnu::always_inline]] inline Vector<Real, P> row(const Symmetric<Real, P>& a, std::size_t i) {
  return make_vector<P>(
      [i](auto j, const auto& m) __attribute__((always_inline)) { return m(i, j); }, a);
}

template <class Real, std::size_t P>
[[gnu::always_inline]] inline Vector<Real, P> diagonal(const Symmetric<Real, P>& a) {
  return make_vector<P>(
      [](auto i, const auto& m) __attribute__((always_inline)) { return m(i, i); }, a);
}

template <class Real, std::size_t P>
[[gnu::always_inline]] inline Vector<Real, P> multiply(const Symmetric<Real, P>& a, const Vector<Real, P>& b) {
  return make_vector<P>(
      [](auto i, const auto& m, const auto& v) __attribute__((always_inline)) { return dot(row(m, i), v); }, a, b);
}

template <class Real, std::size_t P>
[[gnu::always_inline]] inline Symmetric<Real, P> add(Symmetric<Real, P> a, const Symmetric<Real, P>& b) {
  unroll<Symmetric<Real, P>::size>(
      [](auto i, auto& x, const auto& y) __attribute__((always_inline)) { x.upper[i] = x.upper[i] + y.upper[i]; }, a,
      b);
  return a;
}

template <class Real, std::size_t P>
[[gnu::always_inline]] inline Symmetric<Real, P> add_diagonal(Symmetric<Real, P> a, const Vector<Real, P>& d) {
  unroll<P>(
      [](auto i, auto& m, const auto& v) __attribute__((always_inline)) { m(i, i) = m(i, i) + v[i]; }, a, d);
  return a;
}

/// Whether |det A| <= max(P, terms) eps |A|^P, with |A|^P read as the product of the row norms: Hadamard's bound on
/// |det A|. Scaling a row scales both sides, so that a ridge of 10^16 in one component, which makes a matrix no harder
/// to solve, does not make it singular. Elements that are sums of many `terms`, as those of J'WJ over n observations,
/// are off by as many roundings: without them a thousand observations of rank P - 1 pass for regular.
template <class Real, std::size_t P>
[[gnu::always_inline]] inline Mask<Real> is_singular(const Symmetric<Real, P>& a, const Real& determinant,
                                                     std::size_t terms) {
  const double threshold = static_cast<double>(terms < P ? P : terms) * std::numeric_limits<double>::epsilon();
  Real bound(threshold * threshold);
  unroll<P>(
      [](auto i, Real& product, const auto& m) __attribute__((always_inline)) {
        Real off_diagonal(0.0);
        unroll<P>(
            [](auto j, auto k, Real& sum, const auto& n) __attribute__((always_inline)) {
              if constexpr (j != k) sum = sum + n(k, j) * n(k, j);
            },
            i, off_diagonal, m);
        product = product * mul_add(m(i, i), m(i, i), off_diagonal);
      },
      bound, a);
  return determinant * determinant <= bound;
}

/// The adjugate of a 3 x 3 matrix A and det A, which together are its inverse: the fastest form, and stable enough for
/// indefinite matrices.
template <class Real>
struct Adjugate {
  Symmetric<Real, 3> matrix;
  Real determinant;
  Mask<Real> singular;
};

template <class Real>
[[gnu::always_inline]] inline Adjugate<Real> adjugate(const Symmetric<Real, 3>& a, std::size_t terms = 3) {
  const Symmetric<Real, 3> c{
      {neg_mul_add(a(1, 2), a(1, 2), a(1, 1) * a(2, 2)), neg_mul_add(a(0, 1), a(2, 2), a(0, 2) * a(1, 2)),
       neg_mul_add(a(0, 2), a(1, 1), a(0, 1) * a(1, 2)), neg_mul_add(a(0, 2), a(0, 2), a(0, 0) * a(2, 2)),
       neg_mul_add(a(0, 0), a(1, 2), a(0, 1) * a(0, 2)), neg_mul_add(a(0, 1), a(0, 1), a(0, 0) * a(1, 1))}};
  const Real determinant = dot(row(a, 0), row(c, 0));
  return {c, determinant, is_singular(a, determinant, terms)};
}

/// A = L D L', L with a unit diagonal. An exact zero among leading minors makes it singular: an indefinite matrix may
/// be lost although it is regular, a definite one never is.
template <class Real, std::size_t P>
struct Factorization {
  Symmetric<Real, P> unit_upper;  ///< L' above the diagonal
  Vector<Real, P> inverse_pivot;
  Mask<Real> singular;
};

template <class Real, std::size_t P>
[[gnu::always_inline]] inline Factorization<Real, P> factorize(const Symmetric<Real, P>& a, std::size_t terms = P) {
  Symmetric<Real, P> rest = a;
  Factorization<Real, P> f;
  Real determinant(1.0);
  unroll<P>([&](auto k) {
    determinant = determinant * rest(k, k);
    // The inverse of zero would turn the determinant, which is zero, into NaN.
    f.inverse_pivot[k] = select(abs(rest(k, k)) <= Real(0.0), Real(0.0), reciprocal(rest(k, k)));
    unroll<P - k - 1>([&](auto m) {
      constexpr std::size_t i = k + 1 + m;
      const Real factor = rest(k, i) * f.inverse_pivot[k];
      unroll<P - i>([&](auto o) { rest(i, i + o) = neg_mul_add(factor, rest(k, i + o), rest(i, i + o)); });
      f.unit_upper(k, i) = factor;
    });
  });
  f.singular = is_singular(a, determinant, terms);
  return f;
}

template <class Real, std::size_t P>
[[gnu::always_inline]] inline Vector<Real, P> solve(const Factorization<Real, P>& f, Vector<Real, P> b) {
  unroll<P>([&](auto k) {
    unroll<P - k - 1>([&](auto m) { b[k + 1 + m] = neg_mul_add(f.unit_upper(k, k + 1 + m), b[k], b[k + 1 + m]); });
  });
  unroll<P>([&](auto n) {
    constexpr std::size_t k = P - 1 - n;
    b[k] = b[k] * f.inverse_pivot[k];
    unroll<n>([&](auto m) { b[k] = neg_mul_add(f.unit_upper(k, k + 1 + m), b[k + 1 + m], b[k]); });
  });
  return b;
}

/// The diagonal of A^-1 = L^-T D^-1 L^-1.
template <class Real, std::size_t P>
Vector<Real, P> inverse_diagonal(const Factorization<Real, P>& f) {
  return make_vector<P>([&](auto i) {
    Vector<Real, P> column;  // column i of L^-1, from row i on
    column[i] = Real(1.0);
    Real sum = f.inverse_pivot[i];
    unroll<P - 1 - i>([&](auto m) {
      constexpr std::size_t k = i + 1 + m;
      column[k] = -f.unit_upper(i, k);
      unroll<m>([&](auto o) {
        constexpr std::size_t between = i + 1 + o;
        column[k] = neg_mul_add(f.unit_upper(between, k), column[between], column[k]);
      });
      sum = mul_add(column[k] * column[k], f.inverse_pivot[k], sum);
    });
    return sum;
  });
}

template <class Real, std::size_t P>
struct LinearSolution {
  Vector<Real, P> x;
  Mask<Real> singular;
};

/// x = A^-1 b, three unknowns by the adjugate; `terms` as in is_singular. Where A is not finite, x is not finite and
/// `singular` is false.
template <class Real, std::size_t P>
[[gnu::always_inline]] inline LinearSolution<Real, P> solve(const Symmetric<Real, P>& a, const Vector<Real, P>& b,
                                                            std::size_t terms = P) {
  if constexpr (P == 3) {
    const Adjugate<Real> c = adjugate(a, terms);
    const Real inverse = reciprocal(c.determinant);
    return {scale(inverse, multiply(c.matrix, b)), c.singular};
  } else {
    const Factorization<Real, P> f = factorize(a, terms);
    return {solve(f, b), f.singular};
  }
}

}  // namespace ridgeloc::core
