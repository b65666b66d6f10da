#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/registry.hpp"
#include "solvers/kernels/geometry.hpp"
#include "solvers/kernels/solve_batch.hpp"
#include "solvers/methods/methods.hpp"
#include "solvers/models/models.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::solvers {

/// Solver I of `Methods` over a number type.
template <class Real, std::size_t I>
void solve(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
           core::SolutionBatch& out) {
  using Chosen = std::tuple_element_t<I, Methods>;
  SolverOptions own = options;
  Chosen::adjust(own);
  out.reshape(problems.trials());
  core::with_type<typename Chosen::Variants>(Chosen::variant(own), [&]<class Method>(std::type_identity<Method>) {
    const Method method(own);
    with_model<Real, Method::size>(problems, own, [&]<class Model>(std::type_identity<Model>) {
      if constexpr (core::lanes<Real> == 1) {
        solve_one_by_one<Model>(method, problems, oracle, out);
      } else {
        solve_batch<Model>(method, problems, oracle, out);
      }
    });
  });
}

/// All methods, in their order.
using SolverTable = std::array<SolverFunction, std::tuple_size_v<Methods>>;

/// What is compiled for each instruction set.
struct Kernels {
  SolverTable solvers;
  GeometryKernel geometry;
};

/// The kernels over a number type.
template <class Real>
Kernels kernels_over() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return Kernels{{solve<Real, I>...}, geometry_of<Real>};
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
