#include "studies/building/building_replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <string>

#include "core/error.hpp"
#include "core/status.hpp"
#include "studies/building/building_drawing.hpp"
#include "studies/photos/photo_tables.hpp"

namespace ridgeloc::studies {

namespace {

using results::DataTable;
using results::Field;

std::int64_t number(std::size_t value) {
  return static_cast<std::int64_t>(value);
}

DataTable detections(const BuildingCell& settings, const sim::Photo& photo) {
  const sim::BuildingMap& map = *settings.photo.map;
  DataTable table{"detections",
                  {"object", "taken_for", "x_m", "y_m", "z_m", "true_range_m", "pseudorange_m", "box_x_px", "box_y_px",
                   "box_width_px", "box_height_px", "true_height_px", "score"},
                  {}};
  for (const sim::Detection& d : photo.detections) {
    const sim::MapObject& object = map.objects[d.object];
    const sim::View& view = *std::ranges::find(photo.views, d.object, &sim::View::object);
    const double range = sim::pseudorange(settings.photo.options.camera, d, object).range_m(photo.image_distance_mm);
    table.add_row(object.name, map.classes[d.object_class].name, object.centre_m[0], object.centre_m[1],
                  object.centre_m[2], view.range_m, range, d.box.x_px, d.box.y_px, d.box.width_px, d.box.height_px,
                  view.box.height_px, settings.has_scores ? Field(d.score) : Field());
  }
  return table;
}

DataTable map_table(const BuildingScene& scene) {
  const sim::BuildingMap& map = *scene.settings.photo.map;
  DataTable table{"map", {"map", "areas", "objects", "map_graphs"}, {}};
  table.add_row(map.name, number(map.areas.size()), number(map.objects.size()),
                scene.graphs ? Field(number(scene.graphs->graphs().size())) : Field());
  return table;
}

/// Coarse positions of the only photo are its starts, in the same order.
DataTable starts(const BuildingScene& scene, const BuildingScratch& scratch) {
  const sim::BuildingMap& map = *scene.settings.photo.map;
  constexpr double degrees_per_radian = 180.0 / std::numbers::pi;
  DataTable table{"starts", {"start", "x_m", "y_m", "distance_m", "heading_deg", "score", "objects"}, {}};
  for (std::size_t i = 0; i < scratch.starts.size(); ++i) {
    const StartRecord& start = scratch.starts[i];
    Field heading;
    Field score;
    if (scene.graphs) {
      const solvers::CoarsePose& pose = scratch.poses[i];
      heading = degrees_per_radian * scene.graphs->graphs()[pose.graph].heading_rad;
      score = pose.score;
    }
    std::string objects;
    for (std::size_t j = 0; j < start.points; ++j) {
      objects += (j == 0 ? "" : ", ") + map.objects[scratch.observed[start.first + j].object].name;
    }
    table.add_row(number(i + 1), start.place_m[0], start.place_m[1],
                  sim::distance_m(start.place_m, scratch.photos[0].truth_m), heading, score, objects);
  }
  return table;
}

DataTable ends(const sim::BuildingMap& map, const BuildingScratch& scratch) {
  DataTable table{"ends", {"start", "status", "inside", "iterations", "x_m", "y_m", "error_m"}, {}};
  const auto& truth = scratch.photos[0].truth_m;
  for (std::size_t i = 0; i < scratch.ends.size(); ++i) {
    const StartEnd& end = scratch.ends[i];
    table.add_row(number(i + 1), std::string(core::status_names[static_cast<std::size_t>(end.status)]),
                  map.is_inside(end.place_m), end.iterations, end.place_m[0], end.place_m[1],
                  sim::distance_m(end.place_m, truth));
  }
  return table;
}

DataTable outcome(const PhotoOutcome& o) {
  const bool located = o.status == PhotoStatus::Success;
  DataTable table{"outcome", {"status", "starts", "converged", "inside", "x_m", "y_m", "error_m", "iterations"}, {}};
  table.add_row(std::string(photo_status_names[static_cast<std::size_t>(o.status)]), number(o.starts),
                number(o.converged), number(o.inside), located ? Field(o.x_m) : Field(),
                located ? Field(o.y_m) : Field(), located ? Field(o.error_m) : Field(),
                located ? Field(o.iterations) : Field());
  return table;
}

}  // namespace

Replay replay_building(const BuildingScene& scene, std::span<const Method> methods,
                       std::span<const solvers::SolverOptions> options, std::uint64_t trial, BuildingScratch& scratch) {
  const BuildingCell& settings = scene.settings;
  const sim::BuildingMap& map = *settings.photo.map;
  const NoMonitor monitor;
  static_cast<void>(simulate_building(scene, {trial, 1}, monitor, scratch));
  if (!scratch.photos[0].is_taken) {
    throw core::InputError(fmt::format("trial {} ended as {}: there is nothing to show; take another", trial,
                                       photo_status_names[static_cast<std::size_t>(PhotoStatus::NoPhoto)]));
  }
  Replay replay;
  replay.scene = {map_table(scene), camera_table(scratch.photo), detections(settings, scratch.photo),
                  starts(scene, scratch)};
  std::vector<BuildingPanel> panels;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    static_cast<void>(locate(map, methods[m], options[m], monitor, scratch));
    panels.push_back({methods[m].label, scratch.ends, scratch.outcomes[0]});
    replay.methods.push_back({methods[m].label, methods[m].solver, {ends(map, scratch), outcome(scratch.outcomes[0])}});
  }
  replay.drawing = building_drawing(settings, scratch, panels);
  return replay;
}

}  // namespace ridgeloc::studies
