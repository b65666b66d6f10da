#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "solvers/dilution.hpp"
#include "solvers/methods.hpp"
#include "solvers/solve_batch.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::solvers {

/// Method I of `Methods` over a number type. The usual numbers of points have kernels of their own, the others share
/// one.
template <class Real, std::size_t I>
void solve(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
           core::SolutionBatch& out) {
  using Method = std::tuple_element_t<I, Methods>;
  const Method method{options};
  out.reshape(problems.trials());
  const auto solve_with = [&]<std::size_t Points, bool Scored>() {
    using Model = RangeModel<Real, Points, Scored>;
    if constexpr (core::lanes<Real> == 1) {
      solve_one_by_one<Model>(method, problems, oracle, out);
    } else {
      solve_batch<Model>(method, problems, oracle, out);
    }
  };
  if (problems.has_scores()) return solve_with.template operator()<any_points, true>();
  switch (problems.points()) {
    case 3:
      return solve_with.template operator()<3, false>();
    case 4:
      return solve_with.template operator()<4, false>();
    case 5:
      return solve_with.template operator()<5, false>();
    case 6:
      return solve_with.template operator()<6, false>();
    case 7:
      return solve_with.template operator()<7, false>();
    case 8:
      return solve_with.template operator()<8, false>();
    default:
      return solve_with.template operator()<any_points, false>();
  }
}

/// All methods, in their order.
using SolverTable = std::array<Solver, std::tuple_size_v<Methods>>;

/// What is compiled for each instruction set.
struct Kernels {
  SolverTable solvers;
  DilutionKernel dilution;
};

/// The kernels over a number type.
template <class Real>
Kernels kernels_over() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return Kernels{{solve<Real, I>...}, dilution_of_precision<Real>};
  }
  (std::make_index_sequence<std::tuple_size_v<Methods>>{});
}

/// Those over the packs of an instruction set, each defined in a source file that is compiled for it.
template <core::Isa isa>
Kernels kernels();
template <>
Kernels kernels<core::Isa::Baseline>();
template <>
Kernels kernels<core::Isa::Avx2>();
template <>
Kernels kernels<core::Isa::Avx512>();

}  // namespace ridgeloc::solvers
