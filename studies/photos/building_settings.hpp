#pragma once

#include <span>
#include <vector>

#include "sim/photo.hpp"
#include "solvers/coarse/coarse_matching.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::studies {

/// Sections building and photo: what a photo shows. Section detector: what is detected in it.
std::vector<Setting> photo_settings();
std::vector<Setting> detector_settings();

/// Section detector too: what detections are taken for and how they score, which only those read who locate photos.
std::vector<Setting> recognition_settings();

/// What a cell says about them; the last ones stay at their defaults where it has none. Valid as long as the values.
struct PhotoCell {
  explicit PhotoCell(const Values& values);
  const sim::BuildingMap* map;
  sim::PhotoOptions options;
  sim::DetectorModel detector;
};

/// Where the starts of fine positioning come from.
enum class StartPlaces {
  Coarse,  ///< coarse positions
  Grid,    ///< places all over the map, with the objects rightly told
};
inline constexpr std::array<std::string_view, 2> start_places_names = {"coarse", "grid"};

/// Settings of the `building` experiment: those above, and sections coarse and solver.
std::span<const Setting> building_settings();

struct BuildingCell {
  explicit BuildingCell(const Values& values);
  PhotoCell photo;
  std::size_t detections;  ///< 0: as in Table 1
  bool has_scores;
  StartPlaces starts;
  double start_spacing_m;
  double grid_spacing_m;  ///< of the poses whose views are the map graphs
  std::size_t grid_headings;
  solvers::CoarseOptions coarse;
};

}  // namespace ridgeloc::studies
