#include "sim/field_of_view.hpp"

#include <cmath>
#include <cstdio>

#include "core/random.hpp"
#include "core/units.hpp"

namespace ridgeloc::sim {

std::string FieldOfView::scene_content() const {
  // %a prints every bit of a double, the same on every machine.
  std::array<char, 256> text{};
  const int size = std::snprintf(text.data(), text.size(), "az %a %a el %a %a depth %a %a %s", azimuth_deg[0],
                                 azimuth_deg[1], elevation_deg[0], elevation_deg[1], depth_m[0], depth_m[1],
                                 depth_distribution_names[static_cast<std::size_t>(depth_distribution)].data());
  return {text.data(), static_cast<std::size_t>(size)};
}

SceneStreams::SceneStreams(std::uint64_t seed, const FieldOfView& view)
    : scene(seed, "scene", view.scene_content()), start(seed, "start") {}

namespace {

double interpolate(const std::array<double, 2>& interval, double u) {
  return interval[0] + (interval[1] - interval[0]) * u;
}

double depth(const FieldOfView& view, double u) {
  if (view.depth_distribution == DepthDistribution::Uniform) return interpolate(view.depth_m, u);
  const auto cube = [](double d) { return d * d * d; };
  return core::cube_root(interpolate({cube(view.depth_m[0]), cube(view.depth_m[1])}, u));
}

}  // namespace

void place_objects(const FieldOfView& view, const SceneStreams& streams, std::uint64_t first_trial,
                   core::ProblemBatch& problems) {
  for (std::size_t j = 0; j < problems.points(); ++j) {
    const std::array columns = {problems.position(j, 0), problems.position(j, 1), problems.position(j, 2)};
    for (std::size_t trial = 0; trial < problems.trials(); ++trial) {
      const auto u = core::uniform_triple(streams.scene.block(first_trial + trial, j));
      const auto azimuth = core::sin_cos_turns(interpolate(view.azimuth_deg, u[0]) * core::turns_per_degree);
      const auto elevation = core::sin_cos_turns(interpolate(view.elevation_deg, u[1]) * core::turns_per_degree);
      const double d = depth(view, u[2]);
      columns[0][trial] = true_position_m[0] + d * elevation.cos * azimuth.cos;
      columns[1][trial] = true_position_m[1] + d * elevation.cos * azimuth.sin;
      columns[2][trial] = true_position_m[2] + d * elevation.sin;
    }
  }
  const std::array start = {problems.start(0), problems.start(1), problems.start(2)};
  for (std::size_t trial = 0; trial < problems.trials(); ++trial) {
    const auto direction = core::unit_vector(core::uniform_pair(streams.start.block(first_trial + trial, 0)));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      start[axis][trial] = true_position_m[axis] + view.start_offset_m * direction[axis];
    }
  }
}

}  // namespace ridgeloc::sim
