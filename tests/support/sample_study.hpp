#pragma once
// A small made-up study for tests of the result store: two axes, one point of the grid left out, three
// methods of which one reports metrics alone, and values that exercise NaN, infinity and the limit of the
// moments.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "results/blocks/block.hpp"
#include "results/schema/schema.hpp"

namespace ridgeloc::tests {

inline constexpr std::uint64_t sample_block_trials = 16;
/// Five whole blocks and one of six trials.
inline constexpr std::uint64_t sample_trials = 5 * sample_block_trials + 6;
inline constexpr std::uint64_t sample_blocks = 6;

inline results::Header sample_header() {
  results::Header header;
  header.title = "Sample: µ and σ";
  header.aims = "Is µ < σ?";
  header.experiment = "sample";
  header.experiment_version = 3;
  header.study_hash = "0123456789abcdef";
  header.study_toml = "title = \"Sample: µ and σ\"\nseed = 7\n";
  header.seed = 18446744073709551615u;
  header.trials = sample_trials;
  header.block_trials = sample_block_trials;
  header.kept_trials = 3 * sample_block_trials - 5;
  header.schema.metrics = {{"error_m", "m", "position error", true},
                           {"iterations", "1", "steps taken", false, true},
                           {"crb_m", "m", "Cramér-Rao bound", false}};
  header.schema.events = {{"not_run", "no solver ran"},
                          {"converged", "the step was short"},
                          {"diverged", "it was not", true},
                          {"success", "error below a limit"}};
  header.schema.statuses = 3;
  header.axes = {{"points", "1", "number of points", {std::int64_t{3}, std::int64_t{4}, std::int64_t{7}}},
                 {"sigma_m", "m", "noise", {0.1, 1.0 / 3.0}}};
  header.schema.metrics[0].bound = "crb_m";
  header.schema.metrics[1].chi_square = 3;
  header.cells = {{"c0", {0, 0}}, {"c1", {0, 1}}, {"c2", {1, 0}}, {"c3", {1, 1}}, {"c4", {2, 1}}};
  header.cells[1].bound = results::BoundKind::Quantiles;
  header.cells[4].bound = results::BoundKind::RootMeanSquare;
  header.methods = {{"ols", "m0", "ordinary least squares"},
                    {"rrr k=0.5", "m1", "robust ridge, \"k\" = 0.5"},
                    {"scene", "m2", "what no solver can change"}};
  results::FigureSpec figure;
  figure.name = "error";
  figure.title = "Error";
  figure.x = "points";
  figure.y = {"error_m", "success"};
  figure.statistic = "median";
  figure.group = {"sigma_m", "method"};
  figure.where = {{"points", {"3", "7"}}};
  figure.log_y = true;
  figure.bounds = false;
  results::FigureSpec distribution;
  distribution.name = "distribution";
  distribution.kind = "ecdf";
  distribution.y = {"error_m"};
  header.figures = {figure, distribution};
  return header;
}

inline std::uint64_t sample_trials_of(const results::Header& header, std::uint64_t block) {
  return std::min(header.block_trials, header.trials - block * header.block_trials);
}

/// The same values for the same trial of the same cell, whatever block, study or call it is in.
inline results::BlockSink sample_block(const results::Header& header, std::size_t cell, std::uint64_t block,
                                       std::uint64_t trials) {
  results::BlockSink sink(header, cell, block, trials);
  const std::uint64_t key = std::hash<std::string>()(header.cells[cell].hash);
  const auto uniforms_of = [&](std::uint64_t method, std::uint64_t t) {
    const std::uint64_t trial = block * header.block_trials + t;
    return [engine = std::mt19937_64(key ^ (method << 32) ^ trial)]() mutable {
      return static_cast<double>(engine() >> 11) * 0x1p-53;
    };
  };
  std::vector<double> bound;
  for (std::size_t method = 0; method < 2; ++method) {
    std::vector<std::uint8_t> status, success;
    std::vector<double> error, iterations;
    for (std::uint64_t t = 0; t < trials; ++t) {
      auto uniform = uniforms_of(method, t);
      const bool converged = uniform() < 0.8;
      status.push_back(converged ? 1 : 2);
      error.push_back(converged ? -std::log(uniform()) : std::numeric_limits<double>::quiet_NaN());
      if (uniform() < 0.1) error.back() = std::numeric_limits<double>::infinity();
      if (uniform() < 0.1) error.back() = 3e7;
      success.push_back(error.back() < 1.0 ? 1 : 0);
      iterations.push_back(std::floor(30 * uniform()));
    }
    sink.status(method, status);
    sink.event(method, 3, success);
    sink.metric(method, 0, error);
    sink.metric(method, 1, iterations);
  }
  for (std::uint64_t t = 0; t < trials; ++t) bound.push_back(0.01 + uniforms_of(2, t)());
  sink.metric(2, 2, bound);
  return sink;
}

inline results::BlockSink sample_block(const results::Header& header, std::size_t cell, std::uint64_t block) {
  return sample_block(header, cell, block, sample_trials_of(header, block));
}

/// All blocks of the study as (cell, block).
inline std::vector<std::pair<std::size_t, std::uint64_t>> sample_tasks(const results::Header& header) {
  std::vector<std::pair<std::size_t, std::uint64_t>> tasks;
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell)
    for (std::uint64_t block = 0; block * header.block_trials < header.trials; ++block) tasks.emplace_back(cell, block);
  return tasks;
}

}  // namespace ridgeloc::tests
