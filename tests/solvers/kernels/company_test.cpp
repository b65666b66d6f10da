// Kernels solve several trials at once. What a trial comes to must not depend on its company: not on its lane, its
// neighbours, or when lanes are refilled.

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "sim/field_of_view.hpp"
#include "sim/range_noise.hpp"
#include "solvers/estimators/k_registry.hpp"
#include "solvers/solver.hpp"
#include "tests/support/all_methods.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/same_bits.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

constexpr double sigma_m = 0.3;
constexpr std::size_t trials = RIDGELOC_COMPANY_TRIALS;
constexpr std::size_t few_trials = 300;  // for what there is much of: every option on every model

enum class Measured { Ranges, Pseudoranges };

struct Batch {
  core::ProblemBatch problems;
  std::array<std::vector<double>, 3> truth;
  std::vector<double> image_distance;
  core::Oracle oracle;

  Batch(std::size_t points, std::size_t size, Measured measured = Measured::Ranges) {
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
    if (measured == Measured::Pseudoranges) add_images();
  }

  /// Makes pseudoranges of the ranges: every point is seen somewhere beside the optical centre.
  void add_images() {
    problems.add_images();
    image_distance.resize(problems.trials());
    for (std::size_t t = 0; t < problems.trials(); ++t) {
      image_distance[t] = 4.0 + 1e-3 * static_cast<double>(t % 89);
      const double v = image_distance[t];
      problems.start_image_distance()[t] = v * (1.0 + 1e-4 * static_cast<double>(t % 13));
      for (std::size_t j = 0; j < problems.points(); ++j) {
        const double beside = 0.1 + 0.25 * static_cast<double>((5 * j + t) % 11);
        const double range = problems.measured(j)[t];
        problems.alpha(j)[t] = range * range / (v * v + beside * beside);
        problems.measured(j)[t] = problems.alpha(j)[t] * beside * beside;
      }
    }
    oracle.image_distance = image_distance;
  }

  /// Takes over one trial of another batch.
  void copy_trial(const Batch& from, std::size_t trial, std::size_t slot) {
    problems.copy_trial(from.problems, trial, slot);
    for (std::size_t axis = 0; axis < 3; ++axis) truth[axis][slot] = from.truth[axis][trial];
    if (!image_distance.empty()) image_distance[slot] = from.image_distance[trial];
  }
};

std::vector<core::Isa> supported() {
  std::vector<core::Isa> isas;
  for (std::size_t i = 0; i < core::isa_count; ++i) {
    if (core::is_supported(static_cast<core::Isa>(i))) isas.push_back(static_cast<core::Isa>(i));
  }
  return isas;
}

/// Whether slot `i` of one batch and slot `j` of another came to the same bits.
bool same_trial(const core::SolutionBatch& a, std::size_t i, const core::SolutionBatch& b, std::size_t j) {
  bool same = a.status[i] == b.status[j];
  for (std::size_t axis = 0; axis < 3; ++axis)
    same = same && tests::same_bits_or_nan(a.estimate[axis][i], b.estimate[axis][j]);
  for (const auto column :
       {&core::SolutionBatch::iterations, &core::SolutionBatch::residual_rms_m, &core::SolutionBatch::remaining_step_m,
        &core::SolutionBatch::eta_first, &core::SolutionBatch::eta_last, &core::SolutionBatch::eta_mean}) {
    same = same && tests::same_bits_or_nan((a.*column)[i], (b.*column)[j]);
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
  for (const MethodChoice& method : methods_by_k()) f(*method.entry, method.options);
}

/// Every method with every option, on ranges, with a known height too, and on every model of pseudoranges.
template <class F>
void for_each_choice(F f) {
  const auto by_k = methods_by_k();
  auto methods = methods_by_option();
  for (const MethodChoice& method : methods) f(method, Measured::Ranges, method.name);
  methods.insert(methods.end(), by_k.begin(), by_k.end());
  for (MethodChoice method : methods) {
    method.options.z_mode = solvers::ZMode::Fixed;
    f(method, Measured::Ranges, method.name + ", known height");
  }
  for (const ModelChoice& model : pseudorange_models()) {
    for (MethodChoice method : methods) {
      apply(model, method.options);
      f(method, Measured::Pseudoranges, method.name + ", " + name_of(model));
    }
  }
}

/// The trials of a batch in another order, among as many others that are not numbers.
struct Mixed {
  std::vector<std::size_t> order;  ///< slot -> trial, or beyond the trials
  Batch batch;

  Mixed(const Batch& from, Measured measured)
      : order(2 * from.problems.trials()), batch(from.problems.points(), order.size(), measured) {
    std::mt19937 shuffle(7);
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::shuffle(order, shuffle);
    for (std::size_t slot = 0; slot < order.size(); ++slot) {
      if (is_trial(slot)) {
        batch.copy_trial(from, order[slot], slot);
      } else {
        batch.problems.measured(0)[slot] = std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  bool is_trial(std::size_t slot) const { return order[slot] < order.size() / 2; }

  /// How many trials came to something else than in their own batch.
  std::size_t differing(const core::SolutionBatch& apart, const core::SolutionBatch& together) const {
    std::size_t count = 0;
    for (std::size_t slot = 0; slot < order.size(); ++slot) {
      if (is_trial(slot)) count += same_trial(apart, slot, together, order[slot]) ? 0 : 1;
    }
    return count;
  }
};

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
  const Mixed mixed(batch, Measured::Ranges);
  for (const core::Isa isa : supported()) {
    for_each_method([&](const solvers::SolverEntry& entry, solvers::SolverOptions options) {
      options.similarity = 1.0;  // a smaller one draws by the number of the trial, which a new place changes
      INFO(entry.name << " k " << options.k << " points " << points << " on " << core::name_of(isa));
      core::SolutionBatch together;
      core::SolutionBatch apart;
      entry.kernel(isa)(batch.problems, options, &batch.oracle, together);
      entry.kernel(isa)(mixed.batch.problems, options, &mixed.batch.oracle, apart);
      CHECK(mixed.differing(apart, together) == 0);
    });
  }
}

TEST_CASE("all this holds for every option and for pseudoranges") {
  for (const std::size_t points : {4, 6}) {
    const Batch ranges(points, few_trials);
    const Batch images(points, few_trials, Measured::Pseudoranges);
    const Mixed mixed_ranges(ranges, Measured::Ranges);
    const Mixed mixed_images(images, Measured::Pseudoranges);
    std::size_t converged = 0;
    for_each_choice([&](const MethodChoice& method, Measured measured, const std::string& name) {
      const Batch& batch = measured == Measured::Ranges ? ranges : images;
      const Mixed& mixed = measured == Measured::Ranges ? mixed_ranges : mixed_images;
      INFO(name << ", " << points << " points");
      core::SolutionBatch reference;
      core::SolutionBatch fused;
      core::SolutionBatch together;
      core::SolutionBatch apart;
      method.entry->solve(batch.problems, method.options, &batch.oracle, reference);
      converged += static_cast<std::size_t>(std::ranges::count(reference.status, std::uint8_t{0}));
      solvers::SolverOptions same_draws = method.options;
      same_draws.similarity = 1.0;
      for (const core::Isa isa : supported()) {
        INFO(core::name_of(isa));
        method.entry->kernel(isa)(batch.problems, method.options, &batch.oracle, together);
        if (isa == core::Isa::Baseline) CHECK(differing(reference, together) == 0);
        if (isa == core::Isa::Avx2) fused = together;
        if (isa == core::Isa::Avx512) CHECK(differing(fused, together) == 0);
        method.entry->kernel(isa)(batch.problems, same_draws, &batch.oracle, together);
        method.entry->kernel(isa)(mixed.batch.problems, same_draws, &mixed.batch.oracle, apart);
        CHECK(mixed.differing(apart, together) == 0);
      }
    });
    CHECK(converged > 10'000);
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
      solvers::solver_named("rrr").kernel(isa)(batch.problems, {}, &batch.oracle, out);
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
