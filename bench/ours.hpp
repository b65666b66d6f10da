#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bench/answer.hpp"
#include "core/problem.hpp"
#include "core/solution.hpp"

/// Everything that the benchmarks want from ridgeloc itself.
namespace ridgeloc::bench {

/// One of our solvers on one kernel, named "solver/kernel", stopped as "matched" says.
struct OwnEntry {
  std::string name;
  void (*solve)(const core::ProblemBatch& problems, core::SolutionBatch& out);
};
std::vector<OwnEntry> own_solvers();

/// The answers of one of our solvers.
std::vector<Answer> answers_of(const core::SolutionBatch& solutions);

/// Least-squares minima of the problems by our Gauss-Newton method, iterated until nothing moves any more.
std::vector<Answer> least_squares_minima(const core::ProblemBatch& problems);

/// Fills a shaped batch with the trials first_trial, first_trial + 1, ... of the experiment `ranging` at its defaults.
void generate(std::uint64_t first_trial, core::ProblemBatch& problems);

/// Standard deviation of the range errors that `generate` draws (m): the default of `ranging`.
inline constexpr double range_sigma_m = 0.1;

}  // namespace ridgeloc::bench
