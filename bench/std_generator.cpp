#include "bench/std_generator.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "bench/ours.hpp"
#include "sim/field_of_view.hpp"

namespace ridgeloc::bench {

namespace {

using Uniform = std::uniform_real_distribution<double>;

Uniform radians(const std::array<double, 2>& degrees) {
  constexpr double radian = std::numbers::pi / 180.0;
  return Uniform(degrees[0] * radian, degrees[1] * radian);
}

}  // namespace

void StdGenerator::generate(core::ProblemBatch& problems) {
  const sim::FieldOfView view;
  Uniform azimuth = radians(view.azimuth_deg);
  Uniform elevation = radians(view.elevation_deg);
  Uniform depth(view.depth_m[0], view.depth_m[1]);
  Uniform turn(0.0, 2.0 * std::numbers::pi);
  Uniform height(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, range_sigma_m);

  for (std::size_t trial = 0; trial < problems.trials(); ++trial) {
    for (std::size_t j = 0; j < problems.points(); ++j) {
      const double az = azimuth(engine_);
      const double el = elevation(engine_);
      const double d = depth(engine_);
      problems.position(j, 0)[trial] = d * std::cos(el) * std::cos(az);
      problems.position(j, 1)[trial] = d * std::cos(el) * std::sin(az);
      problems.position(j, 2)[trial] = d * std::sin(el);
      // The camera is at the origin, so the true range is the depth.
      problems.measured(j)[trial] = d + noise(engine_);
    }
    const double phi = turn(engine_);
    const double z = height(engine_);
    const double radius = std::sqrt(1.0 - z * z);
    problems.start(0)[trial] = view.start_offset_m * radius * std::cos(phi);
    problems.start(1)[trial] = view.start_offset_m * radius * std::sin(phi);
    problems.start(2)[trial] = view.start_offset_m * z;
  }
}

}  // namespace ridgeloc::bench
