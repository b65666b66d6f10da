// Kernels solve several trials at once. What a trial comes to must not depend on its company: not on its lane, its
// neighbours, or when lanes are refilled.

#include <algorithm>
#include <array>
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
  std::array<std::vector<double>, 3> truth;
  core::Oracle oracle;

  Batch(std::size_t points, std::size_t size) {
    const sim::FieldOfView view;
    problems.reshape(points, size);
    sim::place_objects(view, sim::SceneStreams(2018, view), 0, problems);
    sim::measure_ranges(sim::noise_registry()[0], {.range_sigma_m = sigma_m}, core::Stream(2018, "noise", "normal"), 0,
                        problems);
    // A truth of its own for every trial, so that a mix-up shows.
    for (std::size_t axis = 0; axis < 3; ++axis) {
      truth[axis].resize(size);
      for (std::size_t t = 0; t < size; ++t) truth[axis][t] = 1e-3 * static_cast<double>((t + axis) % 97);
      oracle.truth[axis] = truth[axis];
    }
    oracle.range_sigma_m = sigma_m;
    oracle.k_error = core::Stream(2018, "k_error");
    oracle.first_trial = 1000;
  }

  /// Takes over one trial of another batch.
  void copy_trial(const Batch& from, std::size_t trial, std::size_t slot) {
    problems.copy_trial(from.problems, trial, slot);
    for (std::size_t axis = 0; axis < 3; ++axis) truth[axis][slot] = from.truth[axis][trial];
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
  for (const auto column :
       {&core::SolutionBatch::iterations, &core::SolutionBatch::residual_rms_m, &core::SolutionBatch::remaining_step_m,
        &core::SolutionBatch::eta_first, &core::SolutionBatch::eta_last, &core::SolutionBatch::eta_mean}) {
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
    for_each_method([&](const solvers::SolverEntry& entry, solvers::SolverOptions options) {
      options.similarity = 1.0;  // a smaller one draws by the number of the trial, which a new place changes
      INFO(entry.name << " k " << options.k << " points " << points << " on " << core::name_of(isa));
      core::SolutionBatch together;
      entry.kernel(isa)(batch.problems, options, &batch.oracle, together);

      // The same trials in another order, among others that are not numbers.
      std::vector<std::size_t> order(2 * trials);
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::ranges::shuffle(order, shuffle);
      Batch mixed(points, 2 * trials);
      for (std::size_t slot = 0; slot < 2 * trials; ++slot) {
        if (order[slot] < trials) {
          mixed.copy_trial(batch, order[slot], slot);
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
        for (std::size_t t = 0; t < trials; ++t) shifted.copy_trial(batch, t, t + shift);
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
        one.copy_trial(batch, t, 0);
        one.oracle.first_trial = batch.oracle.first_trial + t;
        entry.kernel(isa)(one.problems, options, &one.oracle, alone);
        different += same_trial(alone, 0, together, t) ? 0 : 1;
      }
      CHECK(different == 0);
    });
  }
}

TEST_CASE("kernels answer every trial of a batch of any size, and of an empty one") {
  for (const std::size_t size : {0, 1, 7, 8, 9, 15, 16, 17, 33}) {
    for (const core::Isa isa : supported()) {
      const Batch batch(4, size);
      core::SolutionBatch out;
      solvers::find_solver("rrr")->kernel(isa)(batch.problems, {}, &batch.oracle, out);
      CHECK(out.trials() == size);
      CHECK(std::ranges::count(out.status, static_cast<std::uint8_t>(core::Status::NotRun)) == 0);
    }
  }
}

TEST_CASE("scores that are all one change nothing, and general kernels agree with those for a fixed number of points") {
  const Batch plain(
      GENERATE(std::size_t{3}, std::size_t{4}, std::size_t{5}, std::size_t{6}, std::size_t{7}, std::size_t{8}), trials);
  Batch scored(plain.problems.points(), trials);
  scored.problems.add_scores();
  for (std::size_t j = 0; j < scored.problems.points(); ++j) std::ranges::fill(scored.problems.score(j), 1.0);
  for (const core::Isa isa : supported()) {
    for_each_method([&](const solvers::SolverEntry& entry, const solvers::SolverOptions& options) {
      INFO(entry.name << " k " << options.k << " points " << plain.problems.points() << " on " << core::name_of(isa));
      core::SolutionBatch without;
      core::SolutionBatch with;
      entry.kernel(isa)(plain.problems, options, &plain.oracle, without);
      entry.kernel(isa)(scored.problems, options, &scored.oracle, with);
      CHECK(differing(without, with) == 0);
    });
  }
}

TEST_CASE("kernels read scores as the double path does, and stop at any limit") {
  Batch batch(5, trials);
  batch.problems.add_scores();
  for (std::size_t j = 0; j < 5; ++j) {
    for (std::size_t t = 0; t < trials; ++t) {
      batch.problems.score(j)[t] = 0.1 + 0.9 * static_cast<double>((7 * t + j) % 10) / 9.0;
    }
  }
  for_each_method([&](const solvers::SolverEntry& entry, solvers::SolverOptions options) {
    for (const int limit : {0, 1, 2, 3, 4, 30}) {
      options.max_iterations = limit;
      INFO(entry.name << " k " << options.k << " at most " << limit << " steps");
      core::SolutionBatch reference;
      core::SolutionBatch packed;
      entry.solve(batch.problems, options, &batch.oracle, reference);
      entry.kernel(core::Isa::Baseline)(batch.problems, options, &batch.oracle, packed);
      CHECK(differing(reference, packed) == 0);
    }
  });
}
