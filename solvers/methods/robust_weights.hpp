#pragma once

#include <string_view>
#include <tuple>

#include "core/real.hpp"

/// Robust weights w(u) of standardized residuals u = |e| / scale >= 0, between 0 and 1. `tuning` is the constant at
/// which least squares keeps about 95 % efficiency with normal errors, unless the class says otherwise.
namespace ridgeloc::solvers {

/// Huber (1964): min(1, c / u).
struct HuberWeight {
  static constexpr std::string_view name = "huber";
  static constexpr std::string_view summary = "min(1, c / |u|), c = 1.345";
  static constexpr double tuning = 1.345;

  template <class Real>
  Real operator()(const Real& u, const Real& c) const {
    return core::select(u <= c, Real(1.0), c * core::reciprocal(u));
  }
};

/// Tukey's biweight (Beaton and Tukey 1974): (1 - (u / c)^2)^2 up to c, 0 beyond.
struct TukeyWeight {
  static constexpr std::string_view name = "tukey";
  static constexpr std::string_view summary = "(1 - (u / c)^2)^2 inside c = 4.685, nothing beyond";
  static constexpr double tuning = 4.685;

  template <class Real>
  Real operator()(const Real& u, const Real& c) const {
    const Real scaled = u * core::reciprocal(c);
    const Real root = core::neg_mul_add(scaled, scaled, Real(1.0));
    return core::select(u <= c, root * root, Real(0.0));
  }
};

/// Cauchy: 1 / (1 + (u / c)^2).
struct CauchyWeight {
  static constexpr std::string_view name = "cauchy";
  static constexpr std::string_view summary = "1 / (1 + (u / c)^2), c = 2.385";
  static constexpr double tuning = 2.385;

  template <class Real>
  Real operator()(const Real& u, const Real& c) const {
    const Real scaled = u * core::reciprocal(c);
    return core::reciprocal(core::mul_add(scaled, scaled, Real(1.0)));
  }
};

/// Geman and McClure (1985): 1 / (1 + (u / c)^2)^2, c = 1.
struct GemanMcClureWeight {
  static constexpr std::string_view name = "geman_mcclure";
  static constexpr std::string_view summary = "1 / (1 + (u / c)^2)^2, c = 1";
  static constexpr double tuning = 1.0;

  template <class Real>
  Real operator()(const Real& u, const Real& c) const {
    const Real scaled = u * core::reciprocal(c);
    const Real inverse = core::reciprocal(core::mul_add(scaled, scaled, Real(1.0)));
    return inverse * inverse;
  }
};

/// IGG III (Yang 1994): 1 up to k0, (k0 / u) ((k1 - u) / (k1 - k0))^2 up to k1, 0 beyond; k1 = 2 k0, k0 = 1.5.
struct Igg3Weight {
  static constexpr std::string_view name = "igg3";
  static constexpr std::string_view summary = "1 up to c, falling to 0 at 2 c, c = 1.5";
  static constexpr double tuning = 1.5;

  template <class Real>
  Real operator()(const Real& u, const Real& c) const {
    const Real twice = Real(2.0) * c;
    const Real fall = (twice - u) * core::reciprocal(c);
    const Real between = c * core::reciprocal(u) * fall * fall;
    return core::select(u <= c, Real(1.0), core::select(u <= twice, between, Real(0.0)));
  }
};

/// A new one is a class and a line here.
using RobustWeights = std::tuple<HuberWeight, TukeyWeight, CauchyWeight, GemanMcClureWeight, Igg3Weight>;

}  // namespace ridgeloc::solvers
