#pragma once

namespace ridgeloc::bench {

/// Registers every row with Google Benchmark, named "solver/kernel or stop/points" and "generate/generator/points".
/// One iteration of a row is one workload. Counters: `per_trial` (seconds of CPU time), and for solvers `steps`,
/// `rms_error_m` and `converged` as in `Accuracy`.
void register_rows();

}  // namespace ridgeloc::bench
