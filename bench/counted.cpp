#include "bench/counted.hpp"

#include "bench/block.hpp"
#include "bench/ours.hpp"
#include "bench/workload.hpp"
#include "core/error.hpp"
#include "core/isa.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::bench {

namespace {

constexpr std::size_t points = 5;

}  // namespace

void pass(std::string_view work, std::size_t count) {
  if (!core::is_supported(core::Isa::Avx2))
    throw core::InputError("instructions are counted with AVX2, which is not here");
  if (work == "rrr") {
    const core::ProblemBatch& problems = workload(points).batch;
    const solvers::Solver solve = solvers::solver_named("rrr").kernel(core::Isa::Avx2);
    core::SolutionBatch solutions;
    for (std::size_t i = 0; i < count; ++i) solve(problems, matched_options(), nullptr, solutions);
  } else if (work == "block") {
    BlockRun run(core::Isa::Avx2);
    for (std::size_t i = 0; i < count; ++i) run.run(0);
  } else {
    throw core::InputError("there is no work \"" + std::string(work) + "\"; one of: rrr, block");
  }
}

}  // namespace ridgeloc::bench
