#include "studies/measured/epoch_geometry.hpp"

#include <algorithm>

namespace ridgeloc::studies {

namespace {

void add(std::string& note, const char* word) {
  if (!note.empty()) note += ' ';
  note += word;
}

}  // namespace

EpochGeometry geometry_of_epoch(const Epoch& epoch, bool knows_height) {
  EpochGeometry out;
  if (epoch.readings.empty()) return out;
  std::vector<Place> places;
  double mean_range = 0.0;
  for (const Reading& reading : epoch.readings) {
    places.push_back(reading.at);
    mean_range += reading.range_m / static_cast<double>(epoch.readings.size());
  }
  const std::size_t unknowns = knows_height ? 2 : 3;
  const Extent extent = extent_of(places, knows_height);
  std::ranges::sort(places);
  out.distinct = static_cast<std::size_t>(std::unique(places.begin(), places.end()) - places.begin());
  out.is_solvable = out.distinct >= unknowns;
  for (std::size_t axis = 0; axis < out.start.size(); ++axis)
    out.start[axis] = extent.mean[axis] + mean_range * extent.normal[axis];
  if (out.distinct < epoch.readings.size()) add(out.note, note_of_duplicates);
  if (out.is_solvable && extent.dimensions + 1 == unknowns) add(out.note, note_of_mirror);
  if (out.is_solvable && extent.dimensions + 1 < unknowns) add(out.note, note_of_line);
  return out;
}

}  // namespace ridgeloc::studies
