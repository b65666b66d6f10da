#pragma once

#include <type_traits>

#include "core/problem.hpp"
#include "solvers/models/kernel_size.hpp"
#include "solvers/models/pseudorange_model.hpp"
#include "solvers/models/range_model.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

/// Calls f with the model, as std::type_identity, that a batch and the options ask for. Pseudoranges, and ranges with a
/// known height, have small kernels, whatever `size` says.
template <class Real, KernelSize size, class F>
void with_model(const core::ProblemBatch& problems, const SolverOptions& options, F f) {
  using Narrow = typename core::RealTraits<Real>::Narrow;
  const bool height_known = options.z_mode == ZMode::Fixed;
  if (problems.has_images()) {
    if (options.v_mode == VMode::Fixed) {
      if (height_known) return f(std::type_identity<PseudorangeModel<Narrow, 2, false>>{});
      return f(std::type_identity<PseudorangeModel<Narrow, 3, false>>{});
    }
    if (height_known) return f(std::type_identity<PseudorangeModel<Narrow, 2, true>>{});
    return f(std::type_identity<PseudorangeModel<Narrow, 3, true>>{});
  }
  if (height_known) return f(std::type_identity<RangeModel<Narrow, any_points, 2>>{});
  if constexpr (size == KernelSize::Unrolled && has_specialized_kernels) {
    if (!problems.has_scores() && options.jacobian == Jacobian::Exact) {
      switch (problems.points()) {
        case 3:
          return f(std::type_identity<RangeModel<Real, 3>>{});
        case 4:
          return f(std::type_identity<RangeModel<Real, 4>>{});
        case 5:
          return f(std::type_identity<RangeModel<Real, 5>>{});
        case 6:
          return f(std::type_identity<RangeModel<Real, 6>>{});
        case 7:
          return f(std::type_identity<RangeModel<Real, 7>>{});
        case 8:
          return f(std::type_identity<RangeModel<Real, 8>>{});
        default:
          break;
      }
    }
  }
  f(std::type_identity<RangeModel<std::conditional_t<size == KernelSize::Small, Narrow, Real>>>{});
}

}  // namespace ridgeloc::solvers
