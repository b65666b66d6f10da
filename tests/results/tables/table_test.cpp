#include "results/tables/table.hpp"

#include "tests/support/catch.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc::results;

TEST_CASE("the table of a small result") {
  Summary summary = synthetic_summary();
  summary.header.cells.resize(1);
  summary.statistics.resize(2);
  CHECK(summary_table(summary) == R"(Errors, "small" and large
experiment ranging (version 2), seed 2018, 5 trials per cell, study 0123456789abcdef
error: Monte Carlo standard error; [95 %]: 95 % interval; p05 .. p95: where 90 % of the trials lie
n = a+b: b values are infinite or above 1e6; they enter the median and p05 .. p95, not the mean
!: the error itself is not reliable (fewer than 10 values or outcomes of a kind, heavy tails, or b > 0)
Cells that share trials are not independent.

points = 3, range_sigma_m = 0.1: rr
  metric [unit]      n  mean ± error         median [95 %]  p05 .. p95
  error_m [m]        4  2.50 ± 0.65 !        2.062 [?]      1.01 .. 4
  error_all_m [m]  4+1  2.50 ± 0.65 !        3.031 [?]      1.01 .. inf
  outcome            n  rate [95 %]          count
  converged          5  0.80 [0.38, 0.96] !  4
  max_iterations     5  0.20 [0.04, 0.62] !  1
  stationary         5  1.00 [0.57, 1.00] !  5

points = 3, range_sigma_m = 0.1: rrr
  metric [unit]      n  mean ± error         median [95 %]  p05 .. p95
  error_m [m]        4  1.25 ± 0.32 !        1.031 [?]      0.503 .. 2
  error_all_m [m]  4+1  1.25 ± 0.32 !        1.516 [?]      0.504 .. inf
  outcome            n  rate [95 %]          count
  converged          5  0.80 [0.38, 0.96] !  4
  max_iterations     5  0.20 [0.04, 0.62] !  1
  stationary         5  1.00 [0.57, 1.00] !  5
)");
}

TEST_CASE("outcomes that never happened are shown") {
  Summary summary = synthetic_summary();
  for (Statistics& statistics : summary.statistics) statistics.events = {5, 0, 5};
  CHECK(summary_table(summary).find("  max_iterations     5  0.00 [0.00, 0.43] !") != std::string::npos);
}

TEST_CASE("a cell without trials is shown as such") {
  Summary summary = synthetic_summary();
  summary.statistics[0] = Statistics{};
  CHECK(summary_table(summary).find("  converged          0  -") != std::string::npos);
}

}  // namespace
