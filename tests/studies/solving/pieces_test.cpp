#include "studies/solving/pieces.hpp"

#include <array>
#include <atomic>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/sample.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

/// Random problems with what is known of them, and options that let each take long enough for pieces of 64 trials.
struct Problems {
  explicit Problems(bool images) {
    std::mt19937_64 engine(5);
    std::vector<tests::Sample> samples;
    for (std::size_t t = 0; t < trials; ++t) {
      samples.push_back(tests::random_sample(engine, {.points = points, .images = images, .scores = images}));
      for (std::size_t axis = 0; axis < 3; ++axis) truth[axis].push_back(samples.back().truth[axis]);
      if (images) image_distance.push_back(samples.back().image_distance);
    }
    batch = tests::batch_of(samples);
    for (std::size_t axis = 0; axis < 3; ++axis) oracle.truth[axis] = truth[axis];
    oracle.image_distance = image_distance;
    oracle.range_sigma_m = 0.1;
    oracle.k_error = core::Stream(1, "k_error");
    oracle.first_trial = 7;
    options.max_iterations = 6'000;
    options.k = *solvers::find_k_estimator("oracle_elem");
    options.similarity = 0.7;
    if (images) options.z_mode = solvers::ZMode::Fixed;
  }

  static constexpr std::size_t points = 5;
  static constexpr std::size_t trials = 200;
  std::array<std::vector<double>, 3> truth;
  std::vector<double> image_distance;
  core::ProblemBatch batch;
  core::Oracle oracle;
  solvers::SolverOptions options;
};

}  // namespace

TEST_CASE("pieces of a batch come to the same bits as the whole") {
  const bool images = GENERATE(false, true);
  const Problems problems(images);
  REQUIRE(piece_trials(problems.options, Problems::points) < Problems::trials / 2);
  for (const char* name : {"ols", "rrr"}) {
    const solvers::Solver solver = solvers::solver_named(name).kernel(core::best_isa());
    core::SolutionBatch whole;
    core::SolutionBatch pieces;
    solver(problems.batch, problems.options, &problems.oracle, whole);
    PieceMemory memory;
    REQUIRE(solve_in_pieces(solver, problems.batch, problems.options, problems.oracle, pieces, memory, NoMonitor()));
    for (std::size_t t = 0; t < Problems::trials; ++t) {
      INFO(name << ", trial " << t);
      CHECK(pieces.status[t] == whole.status[t]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        CHECK(tests::same_bits(pieces.estimate[axis][t], whole.estimate[axis][t]));
      }
      for (const auto column : {&core::SolutionBatch::iterations, &core::SolutionBatch::residual_rms_m,
                                &core::SolutionBatch::remaining_step_m, &core::SolutionBatch::eta_mean}) {
        CHECK(tests::same_bits((pieces.*column)[t], (whole.*column)[t]));
      }
      if (images) CHECK(tests::same_bits(pieces.image_distance_mm[t], whole.image_distance_mm[t]));
    }
  }
}

TEST_CASE("a stop is seen between pieces, and after a batch that is one piece") {
  Problems problems(false);
  static std::atomic<int> calls;
  calls = 0;
  static std::atomic<bool> stop;
  stop = false;
  const solvers::Solver solver([](const core::ProblemBatch& batch, const solvers::SolverOptions&, const core::Oracle*,
                                  core::SolutionBatch& out) {
    out.reshape(batch.trials());
    ++calls;
    stop = true;
  });
  std::atomic<std::uint64_t> done{0};
  const Monitor monitor(stop, done);
  PieceMemory memory;
  core::SolutionBatch out;
  CHECK_FALSE(solve_in_pieces(solver, problems.batch, problems.options, problems.oracle, out, memory, monitor));
  CHECK(calls == 1);
  problems.options.max_iterations = 30;
  stop = false;
  CHECK_FALSE(solve_in_pieces(solver, problems.batch, problems.options, problems.oracle, out, memory, monitor));
  CHECK(calls == 2);
}
