#pragma once

#include "bench/problem_set.hpp"
#include "core/problem.hpp"

namespace ridgeloc::bench {

/// Problems per workload: a block of the experiment `ranging`.
inline constexpr std::size_t workload_trials = 4096;

/// The fixed problems with one number of points, in both layouts.
struct Workload {
  core::ProblemBatch batch;
  ProblemSet problems;
};

/// Made at the first call, kept until the program ends. Not for several threads.
const Workload& workload(std::size_t points);

}  // namespace ridgeloc::bench
