// What docs/extending.md adds, over the packs of the baseline: the same bits as over double.

#include <array>
#include <string_view>
#include <tuple>

#include "core/pack.hpp"
#include "sim/range_noise.hpp"
#include "solvers/kernels/kernels.hpp"
#include "tests/support/hand_scene.hpp"
#include "tests/support/noise_draw.hpp"
#include "tests/support/same_bits.hpp"

using namespace ridgeloc;

namespace {

constexpr std::size_t trials = 101;

core::ProblemBatch problems() {
  core::ProblemBatch batch;
  batch.reshape(5, trials);
  const auto value = [](std::size_t i) { return static_cast<double>(i * 7919 % 1000) / 1000.0; };
  for (std::size_t t = 0; t < trials; ++t) {
    for (std::size_t j = 0; j < 5; ++j) {
      const std::array point = {3.0 + 4.0 * value(t + 3 * j), -2.0 + 4.0 * value(t * j + 1), 2.0 * value(t + j)};
      for (std::size_t axis = 0; axis < 3; ++axis) batch.position(j, axis)[t] = point[axis];
      batch.measured(j)[t] = std::hypot(point[0], point[1], point[2]) + 0.2 * (value(5 * t + j) - 0.5);
    }
    for (std::size_t axis = 0; axis < 3; ++axis) batch.start(axis)[t] = value(t + axis) - 0.5;
  }
  return batch;
}

template <class Solver>
constexpr std::size_t index_of = []<std::size_t... I>(std::index_sequence<I...>) {
  return ((std::is_same_v<Solver, std::tuple_element_t<I, solvers::Methods>> ? I : 0) + ...);
}
(std::make_index_sequence<std::tuple_size_v<solvers::Methods>>{});

template <class Solver>
void check_equal(const solvers::SolverOptions& options) {
  const core::ProblemBatch batch = problems();
  core::SolutionBatch packed;
  core::SolutionBatch plain;
  solvers::solve<core::NativeReal, index_of<Solver>>(batch, options, nullptr, packed);
  solvers::solve<double, index_of<Solver>>(batch, options, nullptr, plain);
  CHECK(packed.status == plain.status);
  CHECK(packed.iterations == plain.iterations);
  for (std::size_t axis = 0; axis < 3; ++axis) CHECK(packed.estimate[axis] == plain.estimate[axis]);
}

}  // namespace

TEST_CASE("the documented solver computes the same over packs") {
  check_equal<solvers::Steepest>({});
}

TEST_CASE("the documented estimator of K computes the same over packs") {
  solvers::SolverOptions options;
  options.k = tests::k_index("hocking");
  check_equal<solvers::RidgeRegression>(options);
}

TEST_CASE("the documented weight computes the same over packs") {
  solvers::SolverOptions options;
  options.weight = std::tuple_size_v<solvers::RobustWeights> - 1;
  check_equal<solvers::Irls>(options);
}

TEST_CASE("the documented noise model computes the same over packs") {
  sim::Kernels packed = sim::kernels_over<core::NativeReal>();
  const tests::Draw draw{.points = 5, .trials = trials};
  const auto expected = tests::draw_ranges("laplace", tests::noise_options(), draw);
  const auto drawn = tests::draw_ranges("laplace", tests::noise_options(), draw, packed);
  for (std::size_t j = 0; j < draw.points; ++j) {
    CHECK(std::ranges::equal(drawn.measured(j), expected.measured(j)));
  }
}
