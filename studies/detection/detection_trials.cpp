#include "studies/detection/detection_trials.hpp"

#include <algorithm>
#include <iterator>
#include <limits>

#include "core/random.hpp"
#include "studies/study/setting_builders.hpp"

namespace ridgeloc::studies {

namespace {

/// Most objects of a photo that can be told apart here.
constexpr std::size_t most_slots = 24;

/// Each photo offers as many slots as it can show objects that count; these fill the first of them. A trial draws a
/// slot of photo after photo until one is filled.
std::size_t slots_of(const DetectionCell& cell) {
  const sim::BuildingMap& map = *cell.photo.map;
  const auto of_class = std::ranges::count_if(map.objects, [&](const sim::MapObject& object) {
    return cell.class_name == any_class || map.classes[object.object_class].name == cell.class_name;
  });
  return std::min(static_cast<std::size_t>(of_class), most_slots);
}

std::vector<Setting> make_settings() {
  std::vector<Setting> settings = photo_settings();
  std::ranges::move(detector_settings(), std::back_inserter(settings));
  const Section object("object");
  settings.push_back(object.text("object_class", std::string(any_class), "class of the objects"));
  settings.push_back(object.choice("distance", distance_names, Distance::Any, "near or far objects"));
  settings.push_back(object.integer("least_detections", 0, {0, 12}, "photos with fewer detections do not count"));
  return settings;
}

}  // namespace

std::span<const Setting> detection_experiment_settings() {
  static const std::vector<Setting> settings = make_settings();
  return settings;
}

DetectionCell::DetectionCell(const Values& values)
    : photo(values),
      class_name(std::get<std::string>(values.find("object_class")->second)),
      least_detections(static_cast<std::size_t>(std::get<std::int64_t>(values.find("least_detections")->second))) {
  const auto& name = std::get<std::string>(values.find("distance")->second);
  distance = static_cast<Distance>(std::ranges::find(distance_names, name) - distance_names.begin());
}

bool DetectionCell::counts(const sim::View& view) const {
  const bool near = view.range_m <= photo.detector.near_m;
  if (distance != Distance::Any && near != (distance == Distance::Near)) return false;
  const sim::MapObject& object = photo.map->objects[view.object];
  return class_name == any_class || photo.map->classes[object.object_class].name == class_name;
}

DetectionTrials::DetectionTrials(std::uint64_t seed, const DetectionCell& cell)
    : cell_(cell),
      taker_(*cell.photo.map, cell.photo.options, cell.photo.detector, seed),
      choice_(seed, "object"),
      slots_(slots_of(cell)) {}

const sim::View* DetectionTrials::find_object(std::uint64_t trial, sim::Photo& photo) const {
  for (std::uint64_t attempt = 0; attempt < sim::PhotoTaker::most_attempts; ++attempt) {
    if (!taker_.take_one(trial, attempt, photo) || photo.detections.size() < cell_.least_detections) continue;
    if (!taker_.is_narrow(photo)) continue;
    const double u = core::uniform_pair(choice_.block(trial, attempt))[0];
    const auto slot = static_cast<std::size_t>(u * static_cast<double>(slots_));
    const sim::View* chosen = nullptr;
    std::size_t filled = 0;
    for (const sim::View& view : photo.views) {
      if (!cell_.counts(view)) continue;
      if (filled == slot) chosen = &view;
      ++filled;
    }
    if (filled > slots_) return nullptr;
    if (chosen != nullptr) return chosen;
  }
  return nullptr;
}

bool DetectionTrials::is_crowded(const sim::Photo& photo) const {
  const auto counts = [&](const sim::View& view) { return cell_.counts(view); };
  return static_cast<std::size_t>(std::ranges::count_if(photo.views, counts)) > slots_;
}

std::optional<Sighting> DetectionTrials::take(std::uint64_t trial, sim::Photo& photo) const {
  const sim::View* view = find_object(trial, photo);
  if (view == nullptr) return std::nullopt;
  Sighting sighting{*view, std::nullopt, std::numeric_limits<double>::quiet_NaN()};
  const auto found = std::ranges::find(photo.detections, sighting.view.object, &sim::Detection::object);
  if (found == photo.detections.end()) return sighting;
  sighting.detection = *found;
  const sim::MapObject& object = cell_.photo.map->objects[found->object];
  sighting.pseudorange_m =
      sim::pseudorange(cell_.photo.options.camera, *found, object).range_m(photo.image_distance_mm);
  return sighting;
}

}  // namespace ridgeloc::studies
