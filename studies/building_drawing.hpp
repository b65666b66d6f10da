#pragma once

#include <string>
#include <vector>

#include "results/drawing.hpp"
#include "studies/building_trials.hpp"

namespace ridgeloc::studies {

/// How a method ended from every start of a photo.
struct BuildingPanel {
  std::string label;
  std::vector<StartEnd> ends;
  PhotoOutcome outcome;
};

/// The map around a photo from above, a panel for each method: objects, starts filled where they lead into the map, the
/// positions found, their mean and the truth.
results::Drawing building_drawing(const BuildingCell& settings, const BuildingScratch& scratch,
                                  const std::vector<BuildingPanel>& panels);

}  // namespace ridgeloc::studies
