#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "solvers/dilution.hpp"
#include "solvers/methods.hpp"
#include "solvers/solve_batch.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::solvers {

/// Method I of `Methods` over a number type. The usual numbers of points have kernels of their own, the others share one.
template <class Real, std::size_t I>
void solve(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
           core::SolutionBatch& out) {
  using Method = std::tuple_element_t<I, Methods>;
  const Method method{options};
  out.reshape(problems.trials());
  const auto solve_points = [&]<std::size_t Points>() {
    if constexpr (core::lanes<Real> == 1) {
      solve_one_by_one<Points>(method, problems, oracle, out);
    } else {
      solve_batch<Real, Points>(method, problems, oracle, out);
    }
  };
  switch (problems.points()) {
    case 3: return solve_points.template operator()<3>();
    case 4: return solve_points.template operator()<4>();
    case 5: return solve_points.template operator()<5>();
    case 6: return solve_points.template operator()<6>();
    case 7: return solve_points.template operator()<7>();
    case 8: return solve_points.template operator()<8>();
    default: return solve_points.template operator()<any_points>();
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

}  // namespace ridgeloc::solvers
