#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace ridgeloc::solvers {

/// An object as a camera sees it, or would see it: a class and a box. Sizes are positive.
struct GraphNode {
  std::uint32_t object_class;
  double x_px;  ///< centre of the box, to the right
  double y_px;  ///< centre of the box, down
  double width_px;
  double height_px;
};

/// What would be seen from one pose of the grid on the map.
struct MapGraph {
  std::vector<GraphNode> nodes;
  std::vector<std::size_t> objects;  ///< by node: the number of the object on the map
  double x_m;
  double y_m;
  double heading_rad;
};

/// How b lies to a, left or right and up or down: LR = sgn(x_b - x_a), UD = sgn(y_b - y_a), either of them 0 inside a
/// dead band of half a box: |x_b - x_a| <= (w_a + w_b) / 4, |y_b - y_a| <= (h_a + h_b) / 4.
/// LR + 1 is in bits 0 and 1, UD + 1 in bits 2 and 3.
inline std::uint8_t relation(const GraphNode& a, const GraphNode& b) {
  const auto side = [](double distance, double band) { return distance > band ? 2U : distance < -band ? 0U : 1U; };
  return static_cast<std::uint8_t>(side(b.x_px - a.x_px, (a.width_px + b.width_px) / 4.0) |
                                   side(b.y_px - a.y_px, (a.height_px + b.height_px) / 4.0) << 2U);
}

}  // namespace ridgeloc::solvers
