#pragma once

#include <string>
#include <vector>

#include "results/pictures/floor_plan.hpp"
#include "studies/building/building_trials.hpp"

namespace ridgeloc::studies {

/// How a method ended from every start of a photo.
struct BuildingPanel {
  std::string label;
  std::vector<StartEnd> ends;
  PhotoOutcome outcome;
};

/// The floor around a photo from above, a panel for each method. Coarse starts are filled where they lead to a place
/// inside the map; starts all over the map are tiles that say where they lead.
results::FloorPlan building_drawing(const BuildingCell& settings, const BuildingScratch& scratch,
                                    const std::vector<BuildingPanel>& panels);

}  // namespace ridgeloc::studies
