#include "sim/field_of_view.hpp"

#include <array>
#include <cstdio>

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

}  // namespace ridgeloc::sim
