#include "studies/building_drawing.hpp"

namespace ridgeloc::studies {

results::Drawing building_drawing(const BuildingCell&, const BuildingScratch&, const std::vector<BuildingPanel>&) {
  return {};
}

}  // namespace ridgeloc::studies
