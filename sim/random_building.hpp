#pragma once

#include <cstddef>
#include <cstdint>

#include "sim/building_map.hpp"

namespace ridgeloc::sim {

/// What a random map consists of.
struct RandomBuildingOptions {
  std::uint64_t seed = 1;
  std::size_t wings = 1;     ///< each as large as the floor of the RRR paper
  std::size_t objects = 60;  ///< in each wing
};

/// A map of wings side by side that do not see each other. A wing has a corridor of 2.4 x 52.0 m, one of 2.4 x 33.0 m
/// that leaves it at a random place, a room of 7.0 x 7.0 m with a doorway, and objects of random class at random
/// places: on walls, before them, or under the ceiling, as the class has it. No two overlap. A pure function of the
/// options; a wing does not depend on how many there are. Throws std::invalid_argument if a wing has no room for its
/// objects.
BuildingMap random_building(const RandomBuildingOptions& options);

}  // namespace ridgeloc::sim
