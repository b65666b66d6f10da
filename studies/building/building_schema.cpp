#include "studies/building/building_schema.hpp"

#include <array>
#include <string>

#include "studies/building/building_outcome.hpp"

namespace ridgeloc::studies::building {

namespace {

results::Schema make_schema() {
  results::Schema schema;
  schema.metrics = {
      {"error_m", "m", "2-D position error of located photos", false},
      {"convergence", "1", "share of a photo's starts that converge inside the map", false},
      {"converged_starts", "1", "starts of a photo that converge inside the map", false, true},
      {"iterations", "1", "iterations of located photos, averaged over their converged starts", false},
      {"start_count", "1", "starts of a photo", false, true},
      {"objects_visible", "1", "objects that a photo shows", false, true},
      {"objects_detected", "1", "objects detected in a photo", false, true},
      {"pseudorange_error_m", "m", "error of a photo's pseudoranges, averaged over its detections", false},
      {"coarse_error_m", "m", "distance of the nearest coarse position", false},
      {"coarse_mean_error_m", "m", "distance of a photo's coarse positions, averaged", false},
      {"coarse_right", "1", "share of a photo's coarse positions that take every object for the right one", false},
  };
  for (const Metric compared : {ErrorM, Convergence, Iterations}) schema.metrics[compared].is_compared = true;
  constexpr std::array<const char*, photo_status_names.size()> descriptions = {
      "photos located", "photos of which starts converge, none of them inside the map",
      "photos of which no start converges", "photos without a coarse position",
      "photos that could not be taken: among very many none showed what was asked for"};
  for (std::size_t i = 0; i < descriptions.size(); ++i)
    schema.events.push_back({std::string(photo_status_names[i]), descriptions[i], i > 0});
  schema.statuses = schema.events.size();
  return schema;
}

}  // namespace

const results::Schema& schema() {
  static const results::Schema schema = make_schema();
  return schema;
}

}  // namespace ridgeloc::studies::building
