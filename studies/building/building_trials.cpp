#include "studies/building/building_trials.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/error.hpp"
#include "core/random.hpp"

namespace ridgeloc::studies {

namespace {

/// Fewer points than this do not make a position and an image distance.
constexpr std::size_t fewest_points = 3;

constexpr std::string_view numbers_purpose = "detections";

std::size_t wanted_detections(const BuildingCell& settings, const core::Stream& numbers, std::uint64_t trial) {
  if (settings.detections != 0) return settings.detections;
  return sim::table1_detections(core::uniform_pair(numbers.block(trial, 0))[0]);
}

void require_photos(std::uint64_t seed, const BuildingCell& settings) {
  const sim::BuildingMap& map = *settings.photo.map;
  // Of numbers as in Table 1 the smallest: others may be rare, and end as no_photo.
  const std::size_t wanted = settings.detections != 0 ? settings.detections : fewest_points;
  sim::Photo photo;
  if (sim::PhotoTaker(map, settings.photo.options, settings.photo.detector, seed).take(0, wanted, photo)) return;
  throw core::InputError(
      fmt::format("photo.detections = {}: among {} photos of the map \"{}\" none has {} detections{}; ask for "
                  "fewer, or give the map more objects",
                  settings.detections, sim::PhotoTaker::most_attempts, map.name, wanted,
                  settings.photo.options.widest_spread_deg < 180.0 ? " within photo.widest_spread_deg" : ""));
}

/// Takes the photos of a block and collects their starts.
class Block {
 public:
  Block(const BuildingScene& scene, BuildingScratch& scratch)
      : settings_(scene.settings),
        map_(*settings_.photo.map),
        graphs_(scene.graphs.get()),
        scratch_(scratch),
        taker_(map_, settings_.photo.options, settings_.photo.detector, scene.seed),
        numbers_(scene.seed, numbers_purpose) {
    if (settings_.starts == StartPlaces::Grid) places_ = grid_places(map_, settings_.start_spacing_m);
  }

  void add(std::uint64_t trial) {
    sim::Photo& photo = scratch_.photo;
    if (!taker_.take(trial, wanted_detections(settings_, numbers_, trial), photo)) {
      scratch_.photos.emplace_back().is_taken = false;
      return;
    }
    record(photo);
    if (settings_.starts == StartPlaces::Grid) {
      add_grid(photo);
    } else {
      add_coarse(photo);
    }
    PhotoRecord& record = scratch_.photos.back();
    record.starts = scratch_.starts.size() - first_start_;
  }

 private:
  Observed observed(const sim::Detection& detection, std::size_t object) const {
    const sim::Camera& camera = settings_.photo.options.camera;
    return {object, sim::pseudorange(camera, detection, map_.objects[object]), detection.score};
  }

  void record(const sim::Photo& photo) {
    first_start_ = scratch_.starts.size();
    PhotoRecord& record = scratch_.photos.emplace_back();
    record.truth_m = {photo.pose.position_m[0], photo.pose.position_m[1]};
    record.image_distance_mm = photo.image_distance_mm;
    record.visible = photo.views.size();
    record.detections = photo.detections.size();
    record.coarse_error_m = std::numeric_limits<double>::quiet_NaN();
    record.coarse_mean_error_m = record.coarse_error_m;
    record.coarse_right = record.coarse_error_m;
    for (const sim::Detection& detection : photo.detections) {
      const auto view = std::ranges::find(photo.views, detection.object, &sim::View::object);
      const double range = observed(detection, detection.object).pseudorange.range_m(photo.image_distance_mm);
      record.pseudorange_error_m += std::fabs(range - view->range_m) / static_cast<double>(photo.detections.size());
    }
  }

  void begin_start(const sim::PlanPoint& place) {
    scratch_.starts.push_back({static_cast<std::uint32_t>(scratch_.photos.size() - 1), place,
                               static_cast<std::uint32_t>(scratch_.observed.size()), 0});
  }

  void observe(const sim::Detection& detection, std::size_t object) {
    scratch_.observed.push_back(observed(detection, object));
    ++scratch_.starts.back().points;
  }

  void add_grid(const sim::Photo& photo) {
    if (photo.detections.size() < fewest_points) return;
    for (const sim::PlanPoint& place : places_) {
      begin_start(place);
      for (const sim::Detection& detection : photo.detections) observe(detection, detection.object);
    }
  }

  void add_coarse(const sim::Photo& photo) {
    scratch_.image.clear();
    for (const sim::Detection& d : photo.detections) scratch_.image.push_back(node_of(d.object_class, d.box));
    graphs_->match(scratch_.image, settings_.coarse, scratch_.coarse, scratch_.poses);
    if (scratch_.poses.empty()) return;
    PhotoRecord& record = scratch_.photos.back();
    record.coarse_error_m = std::numeric_limits<double>::infinity();
    record.coarse_mean_error_m = 0.0;
    record.coarse_right = 0.0;
    const double share = 1.0 / static_cast<double>(scratch_.poses.size());
    for (const solvers::CoarsePose& pose : scratch_.poses) {
      const solvers::MapGraph& graph = graphs_->graphs()[pose.graph];
      begin_start({graph.x_m, graph.y_m});
      bool right = true;
      for (std::size_t i = 0; i < photo.detections.size(); ++i) {
        if (pose.matches[i] == solvers::unmatched_node) continue;
        const std::size_t object = graph.objects[pose.matches[i]];
        observe(photo.detections[i], object);
        right = right && object == photo.detections[i].object;
      }
      const double error = sim::distance_m({graph.x_m, graph.y_m}, record.truth_m);
      record.coarse_error_m = std::min(record.coarse_error_m, error);
      record.coarse_mean_error_m += share * error;
      record.coarse_right += right ? share : 0.0;
    }
  }

  const BuildingCell& settings_;
  const sim::BuildingMap& map_;
  const solvers::MapGraphDatabase* graphs_;
  BuildingScratch& scratch_;
  sim::PhotoTaker taker_;
  core::Stream numbers_;
  std::vector<sim::PlanPoint> places_;
  std::size_t first_start_ = 0;
};

/// Sorts the starts by their number of points.
void make_groups(BuildingScratch& scratch) {
  for (StartGroup& group : scratch.groups) group.starts.clear();
  for (std::size_t i = 0; i < scratch.starts.size(); ++i) {
    const std::size_t points = scratch.starts[i].points;
    auto group = std::ranges::find(scratch.groups, points, &StartGroup::points);
    if (group == scratch.groups.end()) {
      scratch.groups.emplace_back().points = points;
      group = scratch.groups.end() - 1;
    }
    group->starts.push_back(static_cast<std::uint32_t>(i));
  }
}

void write_problems(const BuildingCell& settings, const BuildingScratch& scratch, StartGroup& group) {
  const sim::BuildingMap& map = *settings.photo.map;
  const std::size_t trials = group.starts.size();
  core::ProblemBatch& problems = group.problems;
  problems.reshape(group.points, trials);
  if (settings.has_scores) problems.add_scores();
  problems.add_images();
  for (auto& column : group.truth) column.resize(trials);
  group.image_distance.resize(trials);
  const double height = settings.photo.options.height_m;
  for (std::size_t t = 0; t < trials; ++t) {
    const StartRecord& start = scratch.starts[group.starts[t]];
    const PhotoRecord& photo = scratch.photos[start.photo];
    problems.start(0)[t] = start.place_m[0];
    problems.start(1)[t] = start.place_m[1];
    problems.start(2)[t] = height;
    problems.start_image_distance()[t] = settings.photo.options.camera.focal_length_mm;
    group.truth[0][t] = photo.truth_m[0];
    group.truth[1][t] = photo.truth_m[1];
    group.truth[2][t] = height;
    group.image_distance[t] = photo.image_distance_mm;
    for (std::size_t j = 0; j < group.points; ++j) {
      const Observed& observed = scratch.observed[start.first + j];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        problems.position(j, axis)[t] = map.objects[observed.object].centre_m[axis];
      }
      problems.measured(j)[t] = observed.pseudorange.rho;
      problems.alpha(j)[t] = observed.pseudorange.alpha;
      if (settings.has_scores) problems.score(j)[t] = observed.score;
    }
  }
}

}  // namespace

std::size_t photos_at_once(const BuildingCell& settings) {
  constexpr std::size_t starts = 16'384;
  constexpr std::size_t most = 128;
  if (settings.starts == StartPlaces::Coarse) return most;
  return std::max<std::size_t>(starts / grid_size(*settings.photo.map, settings.start_spacing_m), 1);
}

BuildingScene::BuildingScene(std::uint64_t study_seed, const Cell& cell) : seed(study_seed), settings(cell.values) {
  require_photos(seed, settings);
  if (settings.starts != StartPlaces::Coarse) return;
  const sim::PhotoOptions& options = settings.photo.options;
  graphs = shared_map_graphs({std::get<Building>(cell.values.find("map")->second), options.camera, options.height_m,
                              settings.grid_spacing_m, settings.grid_headings});
}

bool simulate_building(const BuildingScene& scene, TrialRange range, const Monitor& monitor, BuildingScratch& scratch) {
  scratch.photos.clear();
  scratch.starts.clear();
  scratch.observed.clear();
  Block block(scene, scratch);
  for (std::size_t t = 0; t < range.count; ++t) {
    if (monitor.stop_requested()) return false;
    block.add(range.first + t);
  }
  make_groups(scratch);
  for (StartGroup& group : scratch.groups) write_problems(scene.settings, scratch, group);
  return true;
}

}  // namespace ridgeloc::studies
