#pragma once

#include <array>
#include <cstddef>

#include "core/matrix3.hpp"
#include "solvers/k_context.hpp"
#include "solvers/options.hpp"

/// Iterative methods over `Real`. A `Method` is made from the solver options and has its `name` and `summary`, the
/// names of the options that it reads, `has_k`, the number `memory_size` of values that it carries from step to step,
/// and
///   Step<Real> step(model, x, iteration, oracle, memory) const;
///   Real weight(score, residual, points) const;   // its weights at the estimate, for the remaining step
namespace ridgeloc::solvers {

/// What a method proposes at one iterate.
template <class Real>
struct Step {
  core::Vector3<Real> dx;     ///< x <- x - dx
  core::Mask<Real> singular;  ///< a matrix could not be inverted: no step
  core::Mask<Real> accepted;  ///< whether |dx| may meet the stop rule
  core::Vector3<Real> k;      ///< the ridge parameter used, for methods that have one
};

/// What a method carries from step to step; zeros at first.
template <class Real, std::size_t Size>
using Memory = std::array<Real, Size>;

}  // namespace ridgeloc::solvers
