#include "bench/rows.hpp"

#include <benchmark/benchmark.h>

#include <string>

#include "bench/answer.hpp"
#include "bench/block.hpp"
#include "bench/ours.hpp"
#include "bench/peer.hpp"
#include "bench/std_generator.hpp"
#include "bench/workload.hpp"

namespace ridgeloc::bench {

namespace {

/// The number of points of bench/sweep.toml.
constexpr std::size_t block_points = 5;

void count_time(benchmark::State& state) {
  state.counters["per_trial"] =
      benchmark::Counter(static_cast<double>(workload_trials),
                         benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void count_accuracy(benchmark::State& state, std::span<const Answer> answers) {
  const Accuracy found = accuracy(answers);
  state.counters["steps"] = found.steps;
  state.counters["rms_error_m"] = found.rms_error_m;
  state.counters["converged"] = found.converged;
}

void solve_own(benchmark::State& state, const OwnSolver& entry, std::size_t points) {
  const core::ProblemBatch& problems = workload(points).batch;
  core::SolutionBatch solutions;
  for ([[maybe_unused]] auto pass : state) entry.solve(problems, matched_options(), nullptr, solutions);
  count_time(state);
  count_accuracy(state, answers_of(solutions));
}

void solve_peer(benchmark::State& state, const PeerEntry& entry, std::size_t points) {
  const auto peer = entry.make(workload(points).problems);
  std::vector<Answer> answers(workload_trials);
  for ([[maybe_unused]] auto pass : state) {
    for (std::size_t trial = 0; trial < workload_trials; ++trial) answers[trial] = peer->solve(trial);
  }
  count_time(state);
  count_accuracy(state, answers);
}

/// `next` fills a batch with trials that it has not drawn before.
template <class Next>
void draw(benchmark::State& state, std::size_t points, Next next) {
  core::ProblemBatch problems;
  problems.reshape(points, workload_trials);
  for ([[maybe_unused]] auto pass : state) {
    next(problems);
    benchmark::ClobberMemory();
  }
  count_time(state);
}

void draw_own(benchmark::State& state, std::size_t points, Generator generate) {
  draw(state, points, [generate, first = std::uint64_t{0}](core::ProblemBatch& problems) mutable {
    generate(first, problems);
    first += problems.trials();
  });
}

void draw_std(benchmark::State& state, std::size_t points) {
  draw(state, points,
       [generator = StdGenerator()](core::ProblemBatch& problems) mutable { generator.generate(problems); });
}

void run_blocks(benchmark::State& state, core::Isa isa) {
  BlockRun run(isa);
  std::uint64_t block = 0;
  for ([[maybe_unused]] auto pass : state) run.run(block++);
  state.counters["per_trial"] = benchmark::Counter(
      static_cast<double>(run.trials()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

template <class Row>
void add(const std::string& name, std::size_t points, Row row) {
  // No MinTime here: it would become part of the name.
  benchmark::RegisterBenchmark((name + "/" + std::to_string(points)).c_str(), row)->Unit(benchmark::kMicrosecond);
}

}  // namespace

void register_rows() {
  for (const std::size_t points : point_counts) {
    for (const OwnSolver& entry : own_solvers()) {
      add(entry.name, points, [=](benchmark::State& state) { solve_own(state, entry, points); });
    }
    for (const PeerEntry& entry : peers()) {
      add(std::string(entry.name), points, [=](benchmark::State& state) { solve_peer(state, entry, points); });
    }
    for (const OwnGenerator& entry : own_generators()) {
      add("generate/" + entry.name, points, [=](benchmark::State& state) { draw_own(state, points, entry.generate); });
    }
    if (points == block_points) {
      for (const OwnGenerator& entry : own_generators()) {
        add("block/" + entry.name, points,
            [isa = *core::find_isa(entry.name)](benchmark::State& state) { run_blocks(state, isa); });
      }
    }
    add("generate/mt19937_64", points, [=](benchmark::State& state) { draw_std(state, points); });
  }
}

}  // namespace ridgeloc::bench
