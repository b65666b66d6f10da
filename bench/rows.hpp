#pragma once

namespace ridgeloc::bench {

/// Registers every row with Google Benchmark, named "solver/kernel or stop/points" and "generate/generator/points".
/// One iteration of a row is one workload. Counters: `ns_per_trial` (CPU time), and for solvers `iterations`,
/// `rms_error_m` and `converged` as in `Accuracy`.
void register_rows();

}  // namespace ridgeloc::bench
