#include "studies/building/building_drawing.hpp"

#include <fmt/format.h>

#include "studies/photos/floor_drawing.hpp"

namespace ridgeloc::studies {

namespace {

using results::DrawnPoint;
using results::PlanMark;

/// A start leads to the right place if it ends this near to it.
constexpr double near_truth_m = 2.0;

PlanMark tile_of(const sim::BuildingMap& map, const StartEnd& end, const std::array<double, 2>& truth) {
  if (end.status != core::Status::Converged) return PlanMark::LostTile;
  if (!map.is_inside(end.place_m)) return PlanMark::OutsideTile;
  const bool right = sim::distance_m(end.place_m, truth) < near_truth_m;
  return right ? PlanMark::GoodTile : PlanMark::WrongTile;
}

class Painter {
 public:
  Painter(const BuildingCell& settings, const BuildingScratch& scratch)
      : settings_(settings), map_(*settings.photo.map), scratch_(scratch), truth_(scratch.photos[0].truth_m) {
    for (const sim::MapObject& object : map_.objects) objects_.push_back(drawn(object));
    for (const sim::Detection& d : scratch.photo.detections) detected_.push_back(objects_[d.object]);
  }

  bool tiled() const { return settings_.starts == StartPlaces::Grid; }

  results::PlanPanel panel(const BuildingPanel& method) const {
    results::PlanPanel panel;
    panel.title = fmt::format("{}: {} of {} starts converge inside the map", method.label, method.outcome.inside,
                              method.outcome.starts);
    if (method.outcome.inside > 0) panel.title += fmt::format(", mean {:.2f} m off", method.outcome.error_m);
    const auto add = [&panel](PlanMark mark, std::vector<DrawnPoint> points) {
      panel.places.push_back({mark, std::move(points)});
    };
    if (tiled()) {
      for (const PlanMark mark : {PlanMark::GoodTile, PlanMark::WrongTile, PlanMark::OutsideTile, PlanMark::LostTile}) {
        add(mark, starts(method, [&](const StartEnd& end) { return tile_of(map_, end, truth_) == mark; }));
      }
    }
    add(PlanMark::Object, objects_);
    add(PlanMark::Used, detected_);
    if (!tiled()) {
      add(PlanMark::Filled, starts(method, [&](const StartEnd& end) { return is_inside(end); }));
      add(PlanMark::Hollow, starts(method, [&](const StartEnd& end) { return !is_inside(end); }));
      std::vector<DrawnPoint> found;
      for (const StartEnd& end : method.ends) {
        if (is_inside(end)) found.push_back(drawn(end.place_m));
      }
      add(PlanMark::Cross, found);
      if (method.outcome.inside > 0) add(PlanMark::Mean, {{method.outcome.x_m, method.outcome.y_m}});
    }
    add(PlanMark::Star, {drawn(truth_)});
    return panel;
  }

  results::DrawingWindow window(const std::vector<BuildingPanel>& methods) const {
    std::vector<DrawnPoint> places;
    if (tiled()) {
      for (const sim::Rectangle& area : map_.areas) {
        for (const DrawnPoint& corner : corners(area)) places.push_back(corner);
      }
      return window_around(places);
    }
    places = detected_;
    places.push_back(drawn(truth_));
    for (const StartRecord& start : scratch_.starts) places.push_back(drawn(start.place_m));
    for (const BuildingPanel& method : methods) {
      for (const StartEnd& end : method.ends) {
        if (is_inside(end)) places.push_back(drawn(end.place_m));
      }
    }
    return window_around(places);
  }

 private:
  bool is_inside(const StartEnd& end) const {
    return end.status == core::Status::Converged && map_.is_inside(end.place_m);
  }

  template <class F>
  std::vector<DrawnPoint> starts(const BuildingPanel& method, F&& wanted) const {
    std::vector<DrawnPoint> places;
    for (std::size_t i = 0; i < method.ends.size(); ++i) {
      if (wanted(method.ends[i])) places.push_back(drawn(scratch_.starts[i].place_m));
    }
    return places;
  }

  const BuildingCell& settings_;
  const sim::BuildingMap& map_;
  const BuildingScratch& scratch_;
  std::array<double, 2> truth_;
  std::vector<DrawnPoint> objects_;
  std::vector<DrawnPoint> detected_;
};

}  // namespace

results::FloorPlan building_drawing(const BuildingCell& settings, const BuildingScratch& scratch,
                                    const std::vector<BuildingPanel>& panels) {
  const Painter painter(settings, scratch);
  results::FloorPlan plan;
  plan.outlines = outlines(*settings.photo.map);
  plan.window = painter.window(panels);
  plan.tile = settings.start_spacing_m;
  for (const BuildingPanel& panel : panels) plan.panels.push_back(painter.panel(panel));
  plan.keys = {{PlanMark::Star, "truth"}, {PlanMark::Used, "detected object"}, {PlanMark::Object, "other object"}};
  if (painter.tiled()) {
    plan.keys.push_back({PlanMark::GoodTile, fmt::format("start leads to within {} m of the truth", near_truth_m)});
    plan.keys.push_back({PlanMark::WrongTile, "elsewhere inside the map"});
    plan.keys.push_back({PlanMark::OutsideTile, "outside of it"});
    plan.keys.push_back({PlanMark::LostTile, "does not converge"});
    plan.footnote = "starts all over the map, every detection taken for its own object";
  } else {
    plan.keys.push_back({PlanMark::Filled, "start that leads into the map"});
    plan.keys.push_back({PlanMark::Hollow, "start that does not"});
    plan.keys.push_back({PlanMark::Cross, "position found"});
    plan.keys.push_back({PlanMark::Mean, "their mean, the answer"});
    plan.footnote =
        "starts are coarse positions, which may lie on each other; each takes detections for objects as it sees them";
  }
  return plan;
}

}  // namespace ridgeloc::studies
