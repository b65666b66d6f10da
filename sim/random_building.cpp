#include "sim/random_building.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

#include "core/random.hpp"
#include "core/stream.hpp"

namespace ridgeloc::sim {

namespace {

enum class Stand { OnWall, BeforeWall, UnderCeiling };

struct Kind {
  const char* name;
  double width_m;
  double height_m;
  double z_m;  ///< of the centre
  Stand stand;
};
constexpr std::array<Kind, 8> kinds = {{{"dispenser", 0.35, 1.0, 0.5, Stand::BeforeWall},
                                        {"bin", 0.35, 0.6, 0.3, Stand::BeforeWall},
                                        {"table", 1.2, 0.75, 0.375, Stand::BeforeWall},
                                        {"cabinet", 0.9, 1.8, 0.9, Stand::BeforeWall},
                                        {"window", 1.2, 1.3, 1.6, Stand::OnWall},
                                        {"lamp", 0.6, 0.25, 2.6, Stand::UnderCeiling},
                                        {"door", 0.9, 2.1, 1.05, Stand::OnWall},
                                        {"extinguisher", 0.25, 0.6, 0.9, Stand::OnWall}}};

constexpr double corridor_width_m = 2.4;
constexpr double long_corridor_m = 52.0;
constexpr double short_corridor_m = 33.0;
constexpr double room_m = 7.0;
constexpr double doorway_m = 1.0;
constexpr double wall_thickness_m = 0.2;
constexpr double wing_spacing_m = 40.0;
constexpr double before_wall_m = 0.25;

/// Numbers of one wing.
class Draws {
 public:
  Draws(std::uint64_t seed, std::size_t wing) : stream_(seed, "random_building"), wing_(wing) {}
  std::array<double, 3> next() { return core::uniform_triple(stream_.block(wing_, next_++)); }

 private:
  core::Stream stream_;
  std::uint64_t wing_;
  std::uint64_t next_ = 0;
};

/// The areas of a wing and its doorway.
void add_plan(double y0, const std::string& wing, Draws& draws, BuildingMap& map) {
  const auto u = draws.next();
  // The branch is in one half of the long corridor, the room in the other.
  const bool left = u[0] < 0.5;
  const double half = 0.5 * long_corridor_m;
  const auto place = [&](bool in_left, double width, double share) {
    return (in_left ? 0.0 : half) + share * (half - width);
  };
  const double branch = place(left, corridor_width_m, u[1]);
  const double room = place(!left, room_m, u[2]);
  const double top = y0 + corridor_width_m;
  const double room_bottom = top + wall_thickness_m;
  map.areas.push_back({wing + "corridor", {0.0, long_corridor_m}, {y0, top}});
  map.areas.push_back({wing + "branch", {branch, branch + corridor_width_m}, {top, top + short_corridor_m}});
  map.areas.push_back({wing + "room", {room, room + room_m}, {room_bottom, room_bottom + room_m}});
  const double door = room + 0.5 * (room_m - doorway_m);
  map.openings.push_back({wing + "doorway", {door, door + doorway_m}, {top, room_bottom}});
}

MapObject draw_object(const std::vector<Rectangle>& areas, Draws& draws) {
  const auto u = draws.next();
  const auto w = draws.next();
  MapObject object;
  object.object_class = static_cast<std::size_t>(u[0] * static_cast<double>(kinds.size()));
  const Kind& kind = kinds[object.object_class];
  object.width_m = kind.width_m;
  object.height_m = kind.height_m;

  const auto length = [](const std::array<double, 2>& side) { return side[1] - side[0]; };
  double all = 0.0;
  for (const Rectangle& area : areas) all += length(area.x_m) + length(area.y_m);
  double at = u[1] * all;
  auto area = areas.begin();
  while (area + 1 != areas.end() && at > length(area->x_m) + length(area->y_m)) {
    at -= length(area->x_m) + length(area->y_m);
    ++area;
  }
  const double inwards = kind.stand == Stand::OnWall ? 0.0 : before_wall_m;
  const auto across = [&](const std::array<double, 2>& side) {
    if (kind.stand == Stand::UnderCeiling) return 0.5 * (side[0] + side[1]);
    return u[2] < 0.5 ? side[0] + inwards : side[1] - inwards;
  };
  const auto along = [&](const std::array<double, 2>& side) { return side[0] + w[0] * length(side); };
  const bool along_x = at < length(area->x_m);
  object.centre_m = {along_x ? along(area->x_m) : across(area->x_m), along_x ? across(area->y_m) : along(area->y_m),
                     kind.z_m};
  return object;
}

}  // namespace

BuildingMap random_building(const RandomBuildingOptions& options) {
  constexpr std::size_t tries_per_object = 200;
  BuildingMap map;
  map.name = "random " + std::to_string(options.seed);
  for (const Kind& kind : kinds) map.classes.push_back({kind.name, kind.width_m, kind.height_m, {}});
  for (std::size_t wing = 0; wing < options.wings; ++wing) {
    Draws draws(options.seed, wing);
    const std::string prefix = options.wings == 1 ? "" : std::to_string(wing + 1) + ": ";
    const std::size_t first_area = map.areas.size();
    const std::size_t first_object = map.objects.size();
    add_plan(static_cast<double>(wing) * wing_spacing_m, prefix, draws, map);
    const std::vector<Rectangle> areas(map.areas.begin() + static_cast<std::ptrdiff_t>(first_area), map.areas.end());
    for (std::size_t tries = 0; map.objects.size() < first_object + options.objects; ++tries) {
      if (tries == tries_per_object * options.objects) throw std::invalid_argument("no room for so many objects");
      MapObject object = draw_object(areas, draws);
      const auto collides = [&](const MapObject& other) { return overlap(object, other); };
      if (std::any_of(map.objects.begin() + static_cast<std::ptrdiff_t>(first_object), map.objects.end(), collides)) {
        continue;
      }
      object.name = prefix + kinds[object.object_class].name + " " + std::to_string(map.objects.size() + 1);
      map.objects.push_back(std::move(object));
    }
  }
  return map;
}

}  // namespace ridgeloc::sim
