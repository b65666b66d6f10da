#include "sim/range_noise.hpp"

#include <cmath>

#include "sim/field_of_view.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

core::ProblemBatch measured_scene(std::size_t points, double sigma_m) {
  const sim::FieldOfView view;
  core::ProblemBatch problems;
  problems.reshape(points, 50);
  sim::place_objects(view, sim::SceneStreams(2018, view), 0, problems);
  sim::measure_ranges(sim::noise_registry()[0], {.range_sigma_m = sigma_m}, core::Stream(2018, "noise"), 0, problems);
  return problems;
}

double true_range(const core::ProblemBatch& p, std::size_t j, std::size_t t) {
  return std::sqrt(p.position(j, 0)[t] * p.position(j, 0)[t] + p.position(j, 1)[t] * p.position(j, 1)[t] +
                   p.position(j, 2)[t] * p.position(j, 2)[t]);
}

}  // namespace

TEST_CASE("without noise the measured range is the true one") {
  const auto p = measured_scene(4, 0.0);
  for (std::size_t t = 0; t < 50; ++t) CHECK(p.measured(3)[t] == true_range(p, 3, t));
}

TEST_CASE("noise levels and numbers of points share the same unit errors") {
  const auto low = measured_scene(7, 0.1);
  const auto high = measured_scene(7, 0.5);
  const auto few = measured_scene(3, 0.1);
  for (std::size_t t = 0; t < 50; ++t) {
    for (std::size_t j = 0; j < 7; ++j) {
      const double r = true_range(low, j, t);
      // Ranges are up to 10 m, so that their sums are exact to 2^-50; divided by sigma.
      CHECK((low.measured(j)[t] - r) / 0.1 == Approx((high.measured(j)[t] - r) / 0.5).margin(4.0 * 0x1p-50 / 0.1));
    }
    for (std::size_t j = 0; j < 3; ++j) CHECK(few.measured(j)[t] == low.measured(j)[t]);
  }
}
