#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>

#include "core/matrix.hpp"
#include "solvers/estimators/k_context.hpp"
#include "solvers/models/kernel_size.hpp"
#include "solvers/options.hpp"

/// Iterative methods over `Real`. A `Method` is made from the solver options and has `has_k`, whether its steps have a
/// ridge parameter; `is_direct`, whether its one step is the whole solution; `size`, how large its kernels may be; the
/// number `memory_size<P>` of values that it carries from step to step, and
///   Step<Real, P> step(model, u, iteration, oracle, memory) const;
///   auto weights(model, u) const;   // its weights at u, for the remaining step
///
/// A solver is one method, or several of which its options choose one: a class with `name`, `summary`, the names of the
/// options that it reads besides the common ones, the type list `Variants`, their choice `variant(options)`,
/// `adjust(options)`, and what it says of its estimates (declaration.hpp).
namespace ridgeloc::solvers {

/// What a method proposes at one iterate.
template <class Real, std::size_t P>
struct Step {
  core::Vector<Real, P> du;          ///< u <- u - du
  core::Mask<Real> singular;         ///< a matrix could not be inverted: no step
  core::Mask<Real> accepted;         ///< whether a short step may meet the stop rule
  core::Vector<Real, P> k;           ///< the ridge parameter used, for methods that have one
  core::Vector<Real, P> proposed{};  ///< du before it was rejected, for methods that may reject it
};

/// A step that is not taken in some lanes: it counts, and does not meet the stop rule.
template <class Real, std::size_t P>
[[gnu::always_inline]] inline Step<Real, P> unless(const core::Mask<Real>& rejected, const core::Vector<Real, P>& du,
                                                   const core::Mask<Real>& singular) {
  return {core::select<Real>(rejected, every<P>(Real(0.0)), du), singular, !rejected, {}, du};
}

/// What a method carries from step to step; zeros at first.
template <class Real, std::size_t Size>
using Memory = std::array<Real, Size>;

/// No lane.
template <class Real>
core::Mask<Real> none() {
  return Real(1.0) < Real(0.0);
}

/// What most methods have in common.
struct MethodDefaults {
  static constexpr bool has_k = false;
  static constexpr bool is_direct = false;
  static constexpr KernelSize size = KernelSize::Small;
  template <std::size_t P>
  static constexpr std::size_t memory_size = 0;
};

/// What most solvers have in common.
struct SolverDefaults {
  /// Settings that the solver does not leave to the user.
  static void adjust(SolverOptions&) {}
};

/// A solver that is the one method `Method`.
template <class Method>
struct SingleVariant : SolverDefaults {
  using Variants = std::tuple<Method>;
  static std::size_t variant(const SolverOptions&) { return 0; }
};

}  // namespace ridgeloc::solvers
