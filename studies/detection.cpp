#include "studies/detection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "core/error.hpp"
#include "core/random.hpp"
#include "sim/photo.hpp"
#include "studies/building_settings.hpp"

namespace ridgeloc::studies {

namespace {

constexpr std::string_view detector_name = "detector";
constexpr std::string_view any_class = "any";
constexpr std::array<std::string_view, 3> distance_names = {"any", "near", "far"};
enum class Distance { Any, Near, Far };

/// Each photo offers so many slots, of which its objects fill some; a trial draws slots until one is filled.
constexpr std::size_t slots = 24;

enum Metric : std::size_t { PseudorangeErrorM, RangeM };
enum Status : std::uint8_t { Detected, Missed };

struct DetectionScratch : Workspace {
  using Workspace::Workspace;

  sim::Photo photo;
  std::vector<std::uint8_t> codes;
  std::vector<double> errors;
  std::vector<double> ranges;
};

std::vector<Setting> make_settings() {
  std::vector<Setting> settings = photo_settings();
  std::ranges::move(detector_settings(), std::back_inserter(settings));
  settings.push_back(
      {"object", "object_class", Kind::Text, std::string(any_class), 0, 0, {}, "1", "class of the objects"});
  settings.push_back({"object",
                      "distance",
                      Kind::Choice,
                      std::string(distance_names[0]),
                      0,
                      0,
                      {distance_names.begin(), distance_names.end()},
                      "1",
                      "near or far objects"});
  settings.push_back({"object",
                      "least_detections",
                      Kind::Integer,
                      std::int64_t{0},
                      0,
                      12,
                      {},
                      "1",
                      "photos with fewer detections do not count"});
  return settings;
}

std::span<const Setting> all_settings() {
  static const std::vector<Setting> settings = make_settings();
  return settings;
}

struct DetectionCell {
  explicit DetectionCell(const Values& values)
      : photo(values),
        class_name(std::get<std::string>(values.find("object_class")->second)),
        least_detections(static_cast<std::size_t>(std::get<std::int64_t>(values.find("least_detections")->second))) {
    const auto& name = std::get<std::string>(values.find("distance")->second);
    distance = static_cast<Distance>(std::ranges::find(distance_names, name) - distance_names.begin());
  }

  bool counts(const sim::View& view) const {
    const bool near = view.range_m <= photo.detector.near_m;
    if (distance != Distance::Any && near != (distance == Distance::Near)) return false;
    const sim::MapObject& object = photo.map->objects[view.object];
    return class_name == any_class || photo.map->classes[object.object_class].name == class_name;
  }

  PhotoCell photo;
  std::string class_name;
  Distance distance;
  std::size_t least_detections;
};

/// Looks through photos until a slot has an object that counts.
const sim::View& find_object(const DetectionCell& cell, const sim::PhotoTaker& taker, const core::Stream& choice,
                             std::uint64_t trial, sim::Photo& photo) {
  for (std::uint64_t attempt = 0; attempt < sim::PhotoTaker::most_attempts; ++attempt) {
    if (!taker.take_one(trial, attempt, photo) || photo.detections.size() < cell.least_detections) continue;
    if (photo.views.size() > slots) {
      throw core::InputError(
          fmt::format("a photo of the map \"{}\" shows {} objects, more than {}; make "
                      "photo.farthest_m smaller",
                      cell.photo.map->name, photo.views.size(), slots));
    }
    const double u = core::uniform_pair(choice.block(trial, attempt))[0];
    const auto slot = static_cast<std::size_t>(u * static_cast<double>(slots));
    if (slot < photo.views.size() && cell.counts(photo.views[slot])) return photo.views[slot];
  }
  throw core::InputError(fmt::format(
      "among {} photos of the map \"{}\" none shows an object with object.object_class = \"{}\", object.distance = "
      "\"{}\" and {} detections; ask for what the map shows",
      sim::PhotoTaker::most_attempts, cell.photo.map->name, cell.class_name,
      distance_names[static_cast<std::size_t>(cell.distance)], cell.least_detections));
}

class DetectionExperiment : public Experiment {
 public:
  std::string_view name() const override { return "detection"; }
  std::string_view summary() const override { return "objects in photos of a building: found or missed (Fig. 5)"; }
  int version() const override { return 1; }
  std::uint64_t block_trials() const override { return 1024; }
  std::span<const Setting> settings() const override { return all_settings(); }

  const results::Schema& schema() const override {
    static const results::Schema schema = [] {
      results::Schema s;
      s.metrics = {{"pseudorange_error_m", "m", "error of the pseudoranges of detected objects", false},
                   {"range_m", "m", "distance of the objects", false}};
      s.events = {{"detected", "objects detected", false}, {"missed", "objects not detected", true}};
      s.statuses = s.events.size();
      return s;
    }();
    return schema;
  }

  void check(const Values& cell) const override {
    const DetectionCell settings(cell);
    if (settings.class_name == any_class) return;
    std::vector<std::string> names;
    for (const sim::ObjectClass& c : settings.photo.map->classes) names.push_back(c.name);
    if (std::ranges::find(names, settings.class_name) != names.end()) return;
    throw core::InputError(fmt::format("object.object_class = \"{}\" is no class of the map \"{}\" (allowed: {}, {})",
                                       settings.class_name, settings.photo.map->name, any_class,
                                       fmt::join(names, ", ")));
  }

  std::string_view example() const override {
    return R"([sweep]
object_class = ["any", "door", "window"]
distance = ["near", "far"]

[[method]]
solver = "detector"

[[figure]]
x = "object_class"
y = "detected"
group = "distance"
)";
  }

  std::vector<std::string> solvers() const override { return {std::string(detector_name)}; }
  std::vector<std::string> settings_of_solver(std::string_view) const override { return {}; }
  std::vector<std::string> extra_labels() const override { return {}; }
  std::unique_ptr<Workspace> make_workspace(core::Isa isa) const override {
    return std::make_unique<DetectionScratch>(isa);
  }

  void run_block(const StudyKey& key, const Cell& cell, std::span<const Method> methods, TrialRange range,
                 Workspace& workspace, results::BlockSink& sink) const override {
    auto& scratch = static_cast<DetectionScratch&>(workspace);
    const DetectionCell settings(cell.values);
    const sim::PhotoTaker taker(*settings.photo.map, settings.photo.options, settings.photo.detector, key.seed);
    const core::Stream choice(key.seed, "object");
    scratch.codes.resize(range.count);
    scratch.errors.assign(range.count, std::numeric_limits<double>::quiet_NaN());
    scratch.ranges.resize(range.count);
    for (std::size_t t = 0; t < range.count; ++t) {
      const sim::View& view = find_object(settings, taker, choice, range.first + t, scratch.photo);
      scratch.ranges[t] = view.range_m;
      const auto found = std::ranges::find(scratch.photo.detections, view.object, &sim::Detection::object);
      scratch.codes[t] = found == scratch.photo.detections.end() ? Missed : Detected;
      if (scratch.codes[t] == Detected) scratch.errors[t] = error_of(settings, *found, view, scratch.photo);
    }
    for (std::size_t m = 0; m < methods.size(); ++m) {
      sink.status(m, scratch.codes);
      sink.metric(m, PseudorangeErrorM, scratch.errors);
      sink.metric(m, RangeM, scratch.ranges);
    }
  }

  std::vector<FailureCounts> count_failures(std::uint64_t seed, const Cell& cell, std::span<const Method> methods,
                                            TrialRange range, Workspace& workspace) const override {
    auto& scratch = static_cast<DetectionScratch&>(workspace);
    const DetectionCell settings(cell.values);
    const sim::PhotoTaker taker(*settings.photo.map, settings.photo.options, settings.photo.detector, seed);
    const core::Stream choice(seed, "object");
    FailureCounts count;
    count.trials = range.count;
    for (std::size_t t = 0; t < range.count; ++t) {
      const sim::View& view = find_object(settings, taker, choice, range.first + t, scratch.photo);
      const auto& found = scratch.photo.detections;
      if (std::ranges::find(found, view.object, &sim::Detection::object) == found.end()) ++count.failed;
    }
    return std::vector<FailureCounts>(methods.size(), count);
  }

  Replay replay(std::uint64_t seed, const Cell& cell, std::span<const Method> methods, std::uint64_t trial,
                Workspace& workspace) const override {
    auto& scratch = static_cast<DetectionScratch&>(workspace);
    const DetectionCell settings(cell.values);
    const sim::PhotoTaker taker(*settings.photo.map, settings.photo.options, settings.photo.detector, seed);
    const sim::View& view = find_object(settings, taker, core::Stream(seed, "object"), trial, scratch.photo);
    (void)view;
    (void)methods;
    return {};
  }

 private:
  static double error_of(const DetectionCell& cell, const sim::Detection& detection, const sim::View& view,
                         const sim::Photo& photo) {
    const double height = cell.photo.map->objects[view.object].height_m * detection.height_factor;
    const double range =
        sim::pseudorange(cell.photo.options.camera, detection.box, height).range_m(photo.image_distance_mm);
    return std::fabs(range - view.range_m);
  }
};

}  // namespace

const Experiment& detection_experiment() {
  static const DetectionExperiment experiment;
  return experiment;
}

}  // namespace ridgeloc::studies
