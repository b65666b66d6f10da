#include "studies/detection/detection_replay.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"
#include "studies/photos/floor_drawing.hpp"
#include "studies/photos/photo_tables.hpp"

namespace ridgeloc::studies {

namespace {

using results::DataTable;
using results::DrawnPoint;
using results::PlanMark;

DataTable object_table(const sim::BuildingMap& map, const sim::View& view) {
  const sim::MapObject& object = map.objects[view.object];
  DataTable table{
      "object",
      {"object", "class", "x_m", "y_m", "z_m", "true_range_m", "box_x_px", "box_y_px", "box_width_px", "box_height_px"},
      {}};
  table.add_row(object.name, map.classes[object.object_class].name, object.centre_m[0], object.centre_m[1],
                object.centre_m[2], view.range_m, view.box.x_px, view.box.y_px, view.box.width_px, view.box.height_px);
  return table;
}

DataTable outcome(const Sighting& sighting) {
  DataTable table{
      "outcome",
      {"status", "box_x_px", "box_y_px", "box_width_px", "box_height_px", "pseudorange_m", "pseudorange_error_m"},
      {}};
  if (!sighting.detection) {
    std::vector<results::Field> row(table.columns.size());
    row[0] = std::string("missed");
    table.rows.push_back(row);
    return table;
  }
  const sim::Detection& d = *sighting.detection;
  table.add_row("detected", d.box.x_px, d.box.y_px, d.box.width_px, d.box.height_px, sighting.pseudorange_m,
                std::fabs(sighting.pseudorange_m - sighting.view.range_m));
  return table;
}

results::FloorPlan drawing(const sim::BuildingMap& map, const sim::Photo& photo, const Sighting& sighting) {
  const DrawnPoint camera{photo.pose.position_m[0], photo.pose.position_m[1]};
  const sim::MapObject& object = map.objects[sighting.view.object];
  std::vector<DrawnPoint> all;
  for (const sim::MapObject& other : map.objects) all.push_back(drawn(other));
  std::vector<DrawnPoint> detected;
  for (const sim::Detection& d : photo.detections) detected.push_back(all[d.object]);
  std::vector<DrawnPoint> seen = {camera};
  for (const sim::View& view : photo.views) seen.push_back(all[view.object]);

  const PlanMark found = sighting.detection ? PlanMark::Filled : PlanMark::Hollow;
  const char* const status = sighting.detection ? "detected" : "missed";
  results::FloorPlan plan;
  plan.window = window_around(seen);
  plan.outlines = outlines(map);
  results::PlanPanel& panel = plan.panels.emplace_back();
  panel.title = fmt::format("{}: {}", object.name, status);
  if (sighting.detection) {
    panel.title += fmt::format(", at {:.2f} m for {:.2f} m", sighting.pseudorange_m, sighting.view.range_m);
  }
  panel.places = {
      {PlanMark::Object, all}, {PlanMark::Used, detected}, {found, {drawn(object)}}, {PlanMark::Star, {camera}}};
  plan.keys = {{PlanMark::Star, "camera"},
               {found, fmt::format("the object, {}", status)},
               {PlanMark::Used, "detected object"},
               {PlanMark::Object, "other object"}};
  return plan;
}

}  // namespace

Replay replay_detection(const DetectionCell& cell, const DetectionTrials& trials, std::uint64_t trial,
                        sim::Photo& photo) {
  const sim::BuildingMap& map = *cell.photo.map;
  const auto sighting = trials.take(trial, photo);
  if (!sighting) {
    throw core::InputError(
        fmt::format("trial {} ended without a photo: there is nothing to show; take another", trial));
  }
  Replay replay;
  replay.scene = {camera_table(photo), object_table(map, sighting->view), outcome(*sighting)};
  replay.drawing = drawing(map, photo, *sighting);
  return replay;
}

}  // namespace ridgeloc::studies
