#pragma once

#include <string_view>

#include "core/elementary.hpp"
#include "solvers/estimators/k_context.hpp"

namespace ridgeloc::solvers {

/// The k that minimises the generalized cross-validation score n |(I - A_k) y|^2 / tr(I - A_k)^2 of the linearised
/// problem, y = W^1/2 e, A_k = W^1/2 J (J'WJ + k I)^-1 J'W^1/2 (Golub, Heath and Wahba 1979).
///
/// With the eigenvalues l_i of J'WJ and alpha = Q'dx_ls: |(I - A_k) y|^2 = y'y - sum l_i alpha_i^2 + sum l_i alpha_i^2
/// (k / (l_i + k))^2 and tr(I - A_k) = n - p + sum k / (l_i + k). The smallest of 49 scores at k = l_max 10^(-8 ... 4),
/// four a decade, is refined by golden section to 10^-4 decades between its neighbours. With n = p the step leaves no
/// residual: y'y less the sum is rounding, which a small trace would divide by next to nothing, and counts as zero. For
/// small k the score then tends to a constant: the search may end at the lower end.
struct GeneralizedCrossValidation : KDefaults {
  static constexpr std::string_view name = "gcv";
  static constexpr std::string_view summary =
      "minimiser of the generalized cross-validation score: Golub, Heath and Wahba";
  static constexpr bool needs_eigenvalues = true;
  static constexpr bool needs_squares = true;

  static constexpr double first_decade = -8.0;
  static constexpr int decades = 12;
  static constexpr int per_decade = 4;
  static constexpr int golden_sections = 18;

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    const Real unit = largest(c.eigenvalues);
    const Score<Real, P> score(c);
    Real best_decade(first_decade);
    Real best = score(unit, best_decade);
    for (int i = 1; i <= decades * per_decade; ++i) {
      const Real decade(first_decade + static_cast<double>(i) / per_decade);
      const Real here = score(unit, decade);
      const core::Mask<Real> better = here < best;
      best_decade = core::select(better, decade, best_decade);
      best = core::select(better, here, best);
    }
    constexpr double golden = 0.6180339887498949;
    Real low = best_decade - Real(1.0 / per_decade);
    Real high = best_decade + Real(1.0 / per_decade);
    for (int i = 0; i < golden_sections; ++i) {
      const Real step = Real(golden) * (high - low);
      const Real left = high - step;
      const Real right = low + step;
      const core::Mask<Real> keep_left = score(unit, left) < score(unit, right);
      low = core::select(keep_left, low, left);
      high = core::select(keep_left, right, high);
    }
    return every<P>(unit * power_of_ten(Real(0.5) * (low + high)));
  }

 private:
  template <class Real>
  static Real power_of_ten(const Real& decade) {
    constexpr double log_of_ten = 2.302585092994046;
    return core::exp(Real(log_of_ten) * decade);
  }

  template <class Real, std::size_t P>
  struct Score {
    core::Vector<Real, P> eigenvalues;
    core::Vector<Real, P> fitted;  ///< l_i alpha_i^2
    Real rest;                     ///< y'y less all of these: the residual sum of squares of the step
    Real freedom;

    explicit Score(const KContext<Real, P>& c)
        : eigenvalues(c.eigenvalues),
          fitted(core::make_vector<P>([&](auto i) { return c.eigenvalues[i] * c.alpha[i] * c.alpha[i]; })),
          rest(c.observations > P ? core::max(c.squares - sum(fitted), Real(0.0)) : Real(0.0)),
          freedom(static_cast<double>(c.observations) - static_cast<double>(P)) {}

    Real operator()(const Real& unit, const Real& decade) const {
      const Real k = unit * power_of_ten(decade);
      Real squares = rest;
      Real trace = freedom;
      core::unroll<P>([&](auto i) {
        const Real shrink = k * core::reciprocal(eigenvalues[i] + k);
        squares = core::mul_add(fitted[i] * shrink, shrink, squares);
        trace = trace + shrink;
      });
      return squares * core::reciprocal(trace * trace);
    }
  };
};

}  // namespace ridgeloc::solvers
