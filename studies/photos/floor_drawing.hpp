#pragma once

#include <vector>

#include "results/pictures/floor_plan.hpp"
#include "sim/building_map.hpp"

namespace ridgeloc::studies {

// What floor plans of all experiments with maps share.

results::DrawnPoint drawn(const sim::PlanPoint& place);
results::DrawnPoint drawn(const sim::MapObject& object);

/// The corners of a rectangle, around it.
std::vector<results::DrawnPoint> corners(const sim::Rectangle& r);

/// Every wall of a map.
std::vector<std::vector<results::DrawnPoint>> outlines(const sim::BuildingMap& map);

/// The smallest window around places, widened by a margin and to a readable proportion. Precondition: there is a place.
results::DrawingWindow window_around(const std::vector<results::DrawnPoint>& places);

}  // namespace ridgeloc::studies
