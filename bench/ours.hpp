#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/answer.hpp"
#include "core/problem.hpp"
#include "core/solution.hpp"
#include "solvers/solver.hpp"

/// Everything that the benchmarks want from ridgeloc itself.
namespace ridgeloc::bench {

/// One of our solvers on one kernel, named "solver/kernel".
struct OwnSolver {
  std::string name;
  solvers::Solver solve;
};
/// All solvers, in double and on every instruction set of this processor.
std::vector<OwnSolver> own_solvers();

/// Their settings: stopped as "matched" says.
const solvers::SolverOptions& matched_options();

/// The answers of one of our solvers.
std::vector<Answer> answers_of(const core::SolutionBatch& solutions);

/// Least-squares minima of the problems by our Gauss-Newton method, iterated until nothing moves any more.
std::vector<Answer> least_squares_minima(const core::ProblemBatch& problems);

/// Fills a shaped batch with the trials first_trial, first_trial + 1, ... of the experiment `ranging` at its defaults,
/// the distance of the start apart.
using Generator = void (*)(std::uint64_t first_trial, core::ProblemBatch& problems);

/// Our generator on one kernel.
struct OwnGenerator {
  std::string name;
  Generator generate;
};
/// On every instruction set of this processor.
std::vector<OwnGenerator> own_generators();

/// How far from the truth every solver starts (m): RIDGELOC_BENCH_START_M of the environment, or the default of
/// `ranging`.
double start_offset_m();

/// Standard deviation of the range errors that `generate` draws (m): the default of `ranging`.
inline constexpr double range_sigma_m = 0.1;

}  // namespace ridgeloc::bench
