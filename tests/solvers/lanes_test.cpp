// Every method on two lanes at once against one trial at a time: the same bits, whatever the neighbour.

#include "tests/solvers/lanes.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "catch.hpp"
#include "sim/field_of_view.hpp"
#include "sim/range_noise.hpp"
#include "solvers/lm.hpp"
#include "solvers/ols.hpp"
#include "solvers/ridge.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

constexpr std::size_t trials = 400;

struct Batch {
  core::ProblemBatch problems;
  std::vector<double> zeros = std::vector<double>(trials, 0.0);
  core::Oracle oracle;

  explicit Batch(std::size_t points) {
    const sim::FieldOfView view;
    problems.reshape(points, trials);
    sim::place_objects(view, sim::SceneStreams(2018, view), 0, problems);
    sim::measure_ranges(sim::noise_registry()[0], 0.3, core::Stream(2018, "noise", "normal"), 0, problems);
    problems.measured(0)[7] = std::numeric_limits<double>::quiet_NaN();
    for (auto& axis : oracle.truth) axis = zeros;
    oracle.range_sigma_m = 0.3;
    oracle.k_error = core::Stream(2018, "k_error");
    oracle.first_trial = 1000;
  }
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double x, double y) {
    return std::bit_cast<std::uint64_t>(x) == std::bit_cast<std::uint64_t>(y) || (x != x && y != y);
  });
}

template <class Method>
void check(const Method& method, const Batch& batch, const solvers::SolverOptions& options) {
  core::SolutionBatch alone;
  solvers::solve_batch(method, batch.problems, options, &batch.oracle, alone);
  // Each trial meets two neighbours, one in either lane.
  for (const std::size_t shift : {std::size_t{1}, trials / 2}) {
    core::SolutionBatch paired;
    paired.reshape(trials);
    for (std::size_t t = 0; t < trials; ++t) {
      solvers::iterate<Lanes>(method, batch.problems, options, &batch.oracle, {t, (t + shift) % trials}, paired);
    }
    CHECK(paired.status == alone.status);
    for (std::size_t axis = 0; axis < 3; ++axis) CHECK(same_bits(paired.estimate[axis], alone.estimate[axis]));
    CHECK(same_bits(paired.iterations, alone.iterations));
    CHECK(same_bits(paired.residual_rms_m, alone.residual_rms_m));
    CHECK(same_bits(paired.remaining_step_m, alone.remaining_step_m));
    CHECK(same_bits(paired.eta_first, alone.eta_first));
    CHECK(same_bits(paired.eta_last, alone.eta_last));
    CHECK(same_bits(paired.eta_mean, alone.eta_mean));
  }
}

}  // namespace

TEST_CASE("on several lanes every method gives the bits that it gives alone") {
  const Batch batch(GENERATE(std::size_t{3}, std::size_t{5}));
  solvers::SolverOptions options;
  check(solvers::Ols{}, batch, options);
  check(solvers::LazyLevenbergMarquardt{}, batch, options);
  options.k_fixed = 0.2;
  options.similarity = 0.8;
  for (std::size_t k = 0; k < std::tuple_size_v<solvers::KEstimators>; ++k) {
    options.k = k;
    options.k_true = k % 2 == 0 ? solvers::KTrue::Elem : solvers::KTrue::Gm;
    check(solvers::Ridge{options, &batch.oracle, false}, batch, options);
    check(solvers::Ridge{options, &batch.oracle, true}, batch, options);
  }
}
