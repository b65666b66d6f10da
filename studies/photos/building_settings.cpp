#include "studies/photos/building_settings.hpp"

#include <algorithm>
#include <iterator>

#include "studies/files/map_reader.hpp"
#include "studies/solving/solver_settings.hpp"
#include "studies/study/setting_builders.hpp"

namespace ridgeloc::studies {

namespace {

template <class T>
const T& get(const Values& values, std::string_view name) {
  return std::get<T>(values.find(name)->second);
}

double number(const Values& values, std::string_view name) {
  return get<double>(values, name);
}

std::size_t count(const Values& values, std::string_view name) {
  return static_cast<std::size_t>(get<std::int64_t>(values, name));
}

template <class Enum, std::size_t N>
Enum chosen(const Values& values, std::string_view name, const std::array<std::string_view, N>& names) {
  return static_cast<Enum>(std::ranges::find(names, get<std::string>(values, name)) - names.begin());
}

/// Whether photos read a setting of solvers. K off by a given similarity is drawn by trial, of which a photo has none
/// of its own for each start; and there is no metric of similarity.
bool is_for_photos(const Setting& setting) {
  constexpr std::array<std::string_view, 5> others = {"similarity", "k_error", "k_error_draw", "ktrue", "eta"};
  return std::ranges::find(others, setting.name) == others.end();
}

std::vector<Setting> make_building_settings() {
  const solvers::CoarseOptions standard;
  const Section photo("photo");
  const Section coarse("coarse");
  std::vector<Setting> settings = photo_settings();
  settings.push_back(photo.integer("detections", 0, {0, 12}, "number of detections (0: 3 to 7 as in Table 1)"));
  settings.push_back(
      photo.choice("scores", {"none", "detector"}, "none", "scores that solvers weigh with: none, or the detector's"));
  std::ranges::move(detector_settings(), std::back_inserter(settings));
  std::ranges::move(recognition_settings(), std::back_inserter(settings));
  const Condition if_coarse{"starts", {std::string(start_places_names[0])}};
  const Condition if_grid{"starts", {std::string(start_places_names[1])}};
  const std::vector<Setting> own = {
      coarse.choice("starts", start_places_names, StartPlaces::Coarse,
                    "where solvers start: at coarse positions, or all over the map with the objects rightly told"),
      read_if(if_grid, coarse.real("start_spacing_m", 1.0, {0.05, 100}, "m", "distance of these places")),
      read_if(if_coarse, coarse.real("grid_spacing_m", 2.0, {0.1, 100}, "m",
                                     "distance of the places that map graphs are made for")),
      read_if(if_coarse, coarse.integer("grid_headings", 8, {1, 360}, "headings of each place")),
      read_if(if_coarse, coarse.integer("coarse_topk", standard.top, {1, 100}, "most coarse positions of a photo")),
      read_if(if_coarse, coarse.real("agreement_weight", standard.agreement_weight, {0, 1}, "1",
                                     "what agreeing relations count beside matched objects (lambda)")),
      read_if(if_coarse, coarse.real("unmatched_penalty", standard.unmatched_penalty, {0, 10}, "1",
                                     "what objects of a map graph count that are not in the photo (mu)")),
      read_if(if_coarse, coarse.choice("coarse_ties", solvers::coarse_ties_names, standard.ties,
                                       "equal scores: by the sizes of boxes, or by the order of the grid")),
  };
  settings.insert(settings.end(), own.begin(), own.end());
  for (Setting& setting : solver_settings()) {
    if (!is_for_photos(setting)) continue;
    // Photos always give pseudoranges.
    if (setting.read_if.setting == "model") setting.read_if = {};
    settings.push_back(std::move(setting));
  }
  settings.push_back(Section("solver").choice("z_mode", solvers::z_mode_names, solvers::ZMode::Fixed,
                                              "height of the camera: an unknown, or known"));
  return settings;
}

}  // namespace

std::vector<Setting> photo_settings() {
  const sim::PhotoOptions standard;
  const sim::Camera& camera = standard.camera;
  const Section photo("photo");
  return {
      Section("building").building("map", *find_building("paper"), "the map of the building"),
      photo.real("camera_height_m", standard.height_m, {0.1, 10}, "m", "height of the camera above the floor"),
      photo.real("wall_distance_m", standard.wall_distance_m, {0, 10}, "m", "the camera is no nearer to walls"),
      photo.integer("least_visible", standard.least_visible, {0, 12}, "photos that show fewer objects are not taken"),
      photo.real("widest_spread_deg", standard.widest_spread_deg, {0.1, 180}, "deg",
                 "photos count whose detections lie no further apart, left to right"),
      photo.real("farthest_m", camera.farthest_m, {1, 1000}, "m", "objects further away are not told apart"),
      photo.real("smallest_box_px", camera.smallest_box_px, {1, 1000}, "1", "nor are boxes lower than so many pixels"),
      photo.real("focal_length_mm", camera.focal_length_mm, {0.1, 1000}, "mm", "focal length of the lens"),
      photo.real("pixel_um", camera.pixel_um, {0.1, 100}, "um", "size of a pixel"),
      photo.real("width_px", camera.width_px, {16, 1e5}, "1", "width of the picture in pixels"),
      photo.real("height_px", camera.height_px, {16, 1e5}, "1", "height of the picture in pixels"),
      photo.real("zoom", camera.zoom, {1, 100}, "1", "digital zoom: the middle part of the sensor, magnified"),
      photo.real("pitch_sigma_deg", standard.pitch_sigma_deg, {0, 20}, "deg",
                 "standard deviation of the camera's pitch"),
      photo.real("roll_sigma_deg", standard.roll_sigma_deg, {0, 20}, "deg", "standard deviation of the camera's roll"),
  };
}

std::vector<Setting> detector_settings() {
  const sim::DetectorModel standard;
  const Section detector("detector");
  return {
      detector.real("recall_near", standard.recall_near, {0, 1}, "1", "share of objects detected near by"),
      detector.real("recall_far", standard.recall_far, {0, 1}, "1", "share of objects detected further away"),
      detector.real("near_m", standard.near_m, {0, 1000}, "m", "up to here is near"),
      detector.real("edge_sigma", standard.edge_sigma, {0, 0.5}, "1",
                    "standard deviation of a box' edges, as a share of its size"),
      detector.real("outlier_rate", standard.outlier_rate, {0, 1}, "1",
                    "share of boxes whose upper or lower edge is far off"),
      detector.range("outlier_size", standard.outlier_size, {0, 1}, "1", "by how much, as a share of the height"),
      detector.real("centre_sigma", standard.centre_sigma, {0, 1}, "1",
                    "standard deviation of a box' centre beside that, as a share of its size"),
      detector.real("height_sigma", standard.height_sigma, {0, 1}, "1",
                    "standard deviation of an object's height in the map, as a share of it"),
  };
}

std::vector<Setting> recognition_settings() {
  const sim::DetectorModel standard;
  const Section detector("detector");
  const Condition if_coarse{"starts", {std::string(start_places_names[0])}};
  const Condition if_scores{"scores", {"detector"}};
  return {
      read_if(if_coarse, detector.real("false_class_rate", standard.false_class_rate, {0, 1}, "1",
                                       "share of detections taken for another class")),
      read_if(if_scores, detector.real("score_low", standard.score_low, {0.01, 1}, "1", "smallest score")),
      read_if(if_scores, detector.real("score_link", standard.score_link, {0, 1}, "1",
                                       "share of scores that tell of the error of the box; the others tell nothing")),
  };
}

PhotoCell::PhotoCell(const Values& values) : map(&get<Building>(values, "map").map()) {
  sim::Camera& camera = options.camera;
  camera.focal_length_mm = number(values, "focal_length_mm");
  camera.pixel_um = number(values, "pixel_um");
  camera.width_px = number(values, "width_px");
  camera.height_px = number(values, "height_px");
  camera.zoom = number(values, "zoom");
  camera.farthest_m = number(values, "farthest_m");
  camera.smallest_box_px = number(values, "smallest_box_px");
  options.height_m = number(values, "camera_height_m");
  options.wall_distance_m = number(values, "wall_distance_m");
  options.pitch_sigma_deg = number(values, "pitch_sigma_deg");
  options.roll_sigma_deg = number(values, "roll_sigma_deg");
  options.least_visible = count(values, "least_visible");
  options.widest_spread_deg = number(values, "widest_spread_deg");
  detector.recall_near = number(values, "recall_near");
  detector.recall_far = number(values, "recall_far");
  detector.near_m = number(values, "near_m");
  detector.edge_sigma = number(values, "edge_sigma");
  detector.outlier_rate = number(values, "outlier_rate");
  detector.outlier_size = get<Interval>(values, "outlier_size");
  detector.centre_sigma = number(values, "centre_sigma");
  detector.height_sigma = number(values, "height_sigma");
  if (!values.contains("false_class_rate")) return;
  detector.false_class_rate = number(values, "false_class_rate");
  detector.score_low = number(values, "score_low");
  detector.score_link = number(values, "score_link");
}

std::span<const Setting> building_settings() {
  static const std::vector<Setting> settings = make_building_settings();
  return settings;
}

BuildingCell::BuildingCell(const Values& values)
    : photo(values),
      detections(count(values, "detections")),
      has_scores(get<std::string>(values, "scores") == "detector"),
      starts(chosen<StartPlaces>(values, "starts", start_places_names)),
      start_spacing_m(number(values, "start_spacing_m")),
      grid_spacing_m(number(values, "grid_spacing_m")),
      grid_headings(count(values, "grid_headings")) {
  coarse.top = count(values, "coarse_topk");
  coarse.agreement_weight = number(values, "agreement_weight");
  coarse.unmatched_penalty = number(values, "unmatched_penalty");
  coarse.ties = chosen<solvers::CoarseTies>(values, "coarse_ties", solvers::coarse_ties_names);
}

}  // namespace ridgeloc::studies
