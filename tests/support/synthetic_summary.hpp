#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "results/summary/summary.hpp"
#include "tests/support/numbers.hpp"

namespace ridgeloc::results {

/// Two metrics, of which the second is heavy-tailed, and three events, of which the first two are statuses.
inline Schema synthetic_schema() {
  Schema schema;
  schema.metrics = {{"error_m", "m", "position error", false},
                    {"error_all_m", "m", "position error, all trials", true}};
  schema.events = {
      {"converged", "converged"}, {"max_iterations", "iteration limit reached"}, {"stationary", "stationary"}};
  schema.statuses = 2;
  return schema;
}

/// Four trials that converged with errors of `scale` times 1, 2, 3, 4, and one that did not.
inline Statistics five_trials(double scale) {
  Statistics statistics;
  statistics.trials = 5;
  statistics.events = {4, 1, 5};
  statistics.metrics = {statistics_of(std::vector{scale, 2 * scale, tests::not_a_number, 3 * scale, 4 * scale}),
                        statistics_of(std::vector{scale, 2 * scale, tests::infinity, 3 * scale, 4 * scale})};
  return statistics;
}

/// The full grid of two numbers of points and two noise levels, solved by rr and rrr.
inline Summary synthetic_summary() {
  Summary summary;
  Header& header = summary.header;
  header.title = "Errors, \"small\" and large";
  header.experiment = "ranging";
  header.experiment_version = 2;
  header.seed = 2018;
  header.trials = 5;
  header.study_hash = "0123456789abcdef0123456789abcdef";
  header.schema = synthetic_schema();
  header.axes = {{"points", "1", "number of points", {std::int64_t{3}, std::int64_t{5}}},
                 {"range_sigma_m", "m", "range noise", {0.1, 0.5}}};
  header.methods = {{"rr", "h1", "ridge regression"}, {"rrr", "h2", "robust ridge regression"}};
  for (std::size_t points = 0; points < 2; ++points) {
    for (std::size_t sigma = 0; sigma < 2; ++sigma) {
      header.cells.push_back({"cell", {points, sigma}});
      summary.statistics.push_back(five_trials(1.0));
      summary.statistics.push_back(five_trials(0.5));
    }
  }
  return summary;
}

}  // namespace ridgeloc::results
