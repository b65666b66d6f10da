#pragma once

#include <string_view>

#include "solvers/estimators/k_context.hpp"
#include "solvers/estimators/true_k.hpp"

namespace ridgeloc::solvers {

/// m_i = sqrt(sigma2 / alpha_i^2) and its inverse, from which five estimators of one k are made (Muniz and Kibria 2009;
/// their numbers). Meant for standardized columns: the values of m and 1 / m compare only if columns of J have norms
/// near 1, as those of ranges have up to the number of points. sigma counts as 1e-9 m at least, as lengths do, so that
/// ranges without noise do not send 1 / m to infinity.
template <class Real, std::size_t P>
Real floored_variance(const KContext<Real, P>& c) {
  return core::max(c.sigma2, Real(k_length_floor_m * k_length_floor_m));
}
template <class Real, std::size_t P>
core::Vector<Real, P> muniz_kibria(const KContext<Real, P>& c) {
  const core::Vector<Real, P> squared = squared_alpha(c);
  const Real deviation = core::sqrt(floored_variance(c));
  return core::make_vector<P>([&](auto i) { return deviation * core::root_and_inverse(squared[i]).inverse; });
}
template <class Real, std::size_t P>
core::Vector<Real, P> inverse_muniz_kibria(const KContext<Real, P>& c) {
  const core::Vector<Real, P> squared = squared_alpha(c);
  const Real inverse = core::root_and_inverse(floored_variance(c)).inverse;
  return core::make_vector<P>([&](auto i) { return core::sqrt(squared[i]) * inverse; });
}

/// k = max 1 / m_i.
struct Mk2 : KDefaults {
  static constexpr std::string_view name = "mk2";
  static constexpr std::string_view summary = "max 1/m_i, m_i = sqrt(sigma2 / alpha_i^2): Muniz and Kibria";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return every<P>(largest(inverse_muniz_kibria(c)));
  }
};

/// k = max m_i.
struct Mk3 : KDefaults {
  static constexpr std::string_view name = "mk3";
  static constexpr std::string_view summary = "max m_i, m_i = sqrt(sigma2 / alpha_i^2): Muniz and Kibria";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return every<P>(largest(muniz_kibria(c)));
  }
};

/// k = geometric mean of 1 / m_i.
struct Mk4 : KDefaults {
  static constexpr std::string_view name = "mk4";
  static constexpr std::string_view summary =
      "geometric mean of 1/m_i, m_i = sqrt(sigma2 / alpha_i^2): Muniz and Kibria";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return every<P>(inverse_geometric_mean(muniz_kibria(c)));
  }
};

/// k = geometric mean of m_i.
struct Mk5 : KDefaults {
  static constexpr std::string_view name = "mk5";
  static constexpr std::string_view summary = "geometric mean of m_i, m_i = sqrt(sigma2 / alpha_i^2): Muniz and Kibria";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return every<P>(inverse_geometric_mean(inverse_muniz_kibria(c)));
  }
};

/// k = median of 1 / m_i.
struct Mk6 : KDefaults {
  static constexpr std::string_view name = "mk6";
  static constexpr std::string_view summary = "median of 1/m_i, m_i = sqrt(sigma2 / alpha_i^2): Muniz and Kibria";

  template <class Real, std::size_t P>
  core::Vector<Real, P> operator()(const KContext<Real, P>& c) const {
    return every<P>(median_of(inverse_muniz_kibria(c)));
  }
};

}  // namespace ridgeloc::solvers
