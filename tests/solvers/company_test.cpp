// Kernels solve several trials at once. What a trial comes to must not depend on its company: not on its lane, its
// neighbours, or when lanes are refilled.

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "catch.hpp"
#include "sim/field_of_view.hpp"
#include "sim/range_noise.hpp"
#include "solvers/k_registry.hpp"
#include "solvers/solver.hpp"

using namespace ridgeloc;

namespace {

constexpr double sigma_m = 0.3;
constexpr std::size_t trials = RIDGELOC_COMPANY_TRIALS;

struct Batch {
  core::ProblemBatch problems;
  std::vector<double> zeros;
  core::Oracle oracle;

  Batch(std::size_t points, std::size_t size) : zeros(size, 0.0) {
    const sim::FieldOfView view;
    problems.reshape(points, size);
    sim::place_objects(view, sim::SceneStreams(2018, view), 0, problems);
    sim::measure_ranges(sim::noise_registry()[0], sigma_m, core::Stream(2018, "noise", "normal"), 0, problems);
    for (auto& axis : oracle.truth) axis = zeros;
    oracle.range_sigma_m = sigma_m;
    oracle.k_error = core::Stream(2018, "k_error");
    oracle.first_trial = 1000;
  }
};

std::vector<core::Isa> supported() {
  std::vector<core::Isa> isas;
  for (std::size_t i = 0; i < core::isa_count; ++i) {
    if (core::is_supported(static_cast<core::Isa>(i))) isas.push_back(static_cast<core::Isa>(i));
  }
  return isas;
}

bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (a != a && b != b);
}

/// Whether slot `i` of one batch and slot `j` of another came to the same bits.
bool same_trial(const core::SolutionBatch& a, std::size_t i, const core::SolutionBatch& b, std::size_t j) {
  bool same = a.status[i] == b.status[j];
  for (std::size_t axis = 0; axis < 3; ++axis) same = same && same_bits(a.estimate[axis][i], b.estimate[axis][j]);
  for (const auto column : {&core::SolutionBatch::iterations, &core::SolutionBatch::residual_rms_m,
                            &core::SolutionBatch::remaining_step_m, &core::SolutionBatch::eta_first,
                            &core::SolutionBatch::eta_last, &core::SolutionBatch::eta_mean}) {
    same = same && same_bits((a.*column)[i], (b.*column)[j]);
  }
  return same;
}

std::size_t differing(const core::SolutionBatch& a, const core::SolutionBatch& b) {
  std::size_t count = 0;
  for (std::size_t t = 0; t < a.trials(); ++t) count += same_trial(a, t, b, t) ? 0 : 1;
  return count;
}

/// Every solver with every estimator of K that it can have.
template <class F>
void for_each_method(F f) {
  for (const auto& entry : solvers::solver_registry()) {
    solvers::SolverOptions options;
    options.k_fixed = 0.2;
    options.similarity = 0.8;
    const bool reads_k = std::ranges::find(entry.options, "k") != entry.options.end();
    for (std::size_t k = 0; k < (reads_k ? solvers::k_estimator_registry().size() : 1); ++k) {
      options.k = k;
      options.k_true = k % 2 == 0 ? solvers::KTrue::Elem : solvers::KTrue::Gm;
      f(entry, options);
    }
  }
}

}  // namespace

TEST_CASE("the baseline kernels give the bits of the double path") {
  const Batch batch(GENERATE(std::size_t{3}, std::size_t{5}, std::size_t{8}, std::size_t{11}), 1003);
  for_each_method([&](const solvers::SolverEntry& entry, const solvers::SolverOptions& options) {
    INFO(entry.name << " k " << options.k << " points " << batch.problems.points());
    core::SolutionBatch reference;
    core::SolutionBatch packed;
    entry.solve(batch.problems, options, &batch.oracle, reference);
    entry.kernel(core::Isa::Baseline)(batch.problems, options, &batch.oracle, packed);
    CHECK(differing(reference, packed) == 0);
  });
}

TEST_CASE("what a trial comes to does not depend on its lane, its neighbours or the refilling of lanes") {
  const std::size_t points = GENERATE(std::size_t{3}, std::size_t{5});
  const Batch batch(points, trials);
  std::mt19937 shuffle(7);
  for (const core::Isa isa : supported()) {
    for_each_method([&](const solvers::SolverEntry& entry, const solvers::SolverOptions& options) {
      INFO(entry.name << " k " << options.k << " points " << points << " on " << core::name_of(isa));
      if (solvers::k_estimator_registry()[options.k].needs_oracle && options.similarity < 1.0) return;  // numbered draws
      core::SolutionBatch together;
      entry.kernel(isa)(batch.problems, options, &batch.oracle, together);

      // The same trials in another order, among others that are not numbers.
      std::vector<std::size_t> order(2 * trials);
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::ranges::shuffle(order, shuffle);
      Batch mixed(points, 2 * trials);
      for (std::size_t slot = 0; slot < 2 * trials; ++slot) {
        if (order[slot] < trials) {
          mixed.problems.copy_trial(batch.problems, order[slot], slot);
        } else {
          mixed.problems.measured(0)[slot] = std::numeric_limits<double>::quiet_NaN();
        }
      }
      core::SolutionBatch apart;
      entry.kernel(isa)(mixed.problems, options, &mixed.oracle, apart);
      std::size_t different = 0;
      for (std::size_t slot = 0; slot < 2 * trials; ++slot) {
        if (order[slot] < trials) different += same_trial(apart, slot, together, order[slot]) ? 0 : 1;
      }
      CHECK(different == 0);
    });
  }
}

TEST_CASE("a trial comes to the same in every lane") {
  constexpr std::size_t most_lanes = 16;
  const Batch batch(5, trials);
  for (const core::Isa isa : supported()) {
    for_each_method([&](const solvers::SolverEntry& entry, const solvers::SolverOptions& options) {
      INFO(entry.name << " k " << options.k << " on " << core::name_of(isa));
      core::SolutionBatch together;
      entry.kernel(isa)(batch.problems, options, &batch.oracle, together);
      for (std::size_t shift = 1; shift < most_lanes; ++shift) {
        Batch shifted(5, trials + shift);
        shifted.oracle.first_trial -= shift;
        for (std::size_t t = 0; t < trials; ++t) shifted.problems.copy_trial(batch.problems, t, t + shift);
        core::SolutionBatch apart;
        entry.kernel(isa)(shifted.problems, options, &shifted.oracle, apart);
        std::size_t different = 0;
        for (std::size_t t = 0; t < trials; ++t) different += same_trial(apart, t + shift, together, t) ? 0 : 1;
        CHECK(different == 0);
      }
    });
  }
}

TEST_CASE("a trial alone comes to what it comes to in a batch") {
  const Batch batch(5, trials);
  for (const core::Isa isa : supported()) {
    for_each_method([&](const solvers::SolverEntry& entry, const solvers::SolverOptions& options) {
      INFO(entry.name << " k " << options.k << " on " << core::name_of(isa));
      core::SolutionBatch together;
      entry.kernel(isa)(batch.problems, options, &batch.oracle, together);
      Batch one(5, 1);
      core::SolutionBatch alone;
      std::size_t different = 0;
      for (std::size_t t = 0; t < trials; ++t) {
        one.problems.copy_trial(batch.problems, t, 0);
        one.oracle.first_trial = batch.oracle.first_trial + t;
        entry.kernel(isa)(one.problems, options, &one.oracle, alone);
        different += same_trial(alone, 0, together, t) ? 0 : 1;
      }
      CHECK(different == 0);
    });
  }
}

TEST_CASE("kernels write no trial beyond the batch") {
  for (const std::size_t size : {1, 7, 8, 9, 15, 16, 17, 33}) {
    for (const core::Isa isa : supported()) {
      const Batch batch(4, size);
      core::SolutionBatch out;
      solvers::find_solver("rrr")->kernel(isa)(batch.problems, {}, &batch.oracle, out);
      CHECK(out.trials() == size);
      CHECK(std::ranges::count(out.status, static_cast<std::uint8_t>(core::Status::NotRun)) == 0);
    }
  }
}
