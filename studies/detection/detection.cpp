#include "studies/detection/detection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "studies/detection/detection_replay.hpp"
#include "studies/detection/detection_trials.hpp"
#include "studies/study/capabilities.hpp"

namespace ridgeloc::studies {

namespace {

enum Metric : std::size_t { PseudorangeErrorM, RangeM };
enum Status : std::uint8_t { Detected, Missed, NoPhoto, Crowded };

struct DetectionScratch : Workspace {
  using Workspace::Workspace;

  sim::Photo photo;
  std::vector<std::uint8_t> codes;
  std::vector<double> errors;
  std::vector<double> ranges;
};

class DetectionSimulation : public Simulation, public TrialReplay {
 public:
  /// Throws core::InputError where the first trial finds no photo, since others then find none as good as never.
  DetectionSimulation(const StudyKey& key, const Cell& cell) : settings_(cell.values), trials_(key.seed, settings_) {
    sim::Photo photo;
    if (trials_.take(0, photo) || trials_.is_crowded(photo)) return;
    throw core::InputError(fmt::format(
        "among {} photos of the map \"{}\" none shows an object with object.object_class = \"{}\", object.distance = "
        "\"{}\" and {} detections{}; ask for what the map shows",
        sim::PhotoTaker::most_attempts, settings_.photo.map->name, settings_.class_name,
        distance_names[static_cast<std::size_t>(settings_.distance)], settings_.least_detections,
        settings_.photo.options.widest_spread_deg < 180.0 ? " within photo.widest_spread_deg" : ""));
  }

  bool run_block(TrialRange range, Workspace& workspace, Monitor& monitor, results::BlockSink& sink) const override {
    constexpr double not_in_population = std::numeric_limits<double>::quiet_NaN();
    auto& scratch = own<DetectionScratch>(workspace);
    scratch.codes.assign(range.count, NoPhoto);
    scratch.errors.assign(range.count, not_in_population);
    scratch.ranges.assign(range.count, not_in_population);
    for (std::size_t t = 0; t < range.count; ++t) {
      if (monitor.stop_requested()) return false;
      monitor.advance(1);
      const auto sighting = trials_.take(range.first + t, scratch.photo);
      if (!sighting) {
        if (trials_.is_crowded(scratch.photo)) scratch.codes[t] = Crowded;
        continue;
      }
      scratch.ranges[t] = sighting->view.range_m;
      scratch.codes[t] = sighting->detection ? Detected : Missed;
      scratch.errors[t] = std::fabs(sighting->pseudorange_m - sighting->view.range_m);
    }
    sink.status(0, scratch.codes);
    sink.metric(0, PseudorangeErrorM, scratch.errors);
    sink.metric(0, RangeM, scratch.ranges);
    return true;
  }

  Replay replay(std::uint64_t trial, Workspace& workspace) const override {
    return replay_detection(settings_, trials_, trial, own<DetectionScratch>(workspace).photo);
  }

 private:
  DetectionCell settings_;
  DetectionTrials trials_;
};

class DetectionExperiment : public Experiment {
 public:
  std::string_view name() const override { return "detection"; }
  std::string_view summary() const override { return "objects in photos of a building: found or missed (Fig. 5)"; }
  int version() const override { return 2; }
  std::uint64_t block_trials() const override { return 1024; }
  std::span<const Setting> settings() const override { return detection_experiment_settings(); }

  const results::Schema& schema() const override {
    static const results::Schema schema = [] {
      results::Schema s;
      s.metrics = {{"pseudorange_error_m", "m", "error of the pseudoranges of detected objects", false},
                   {"range_m", "m", "distance of the objects", false}};
      s.events = {
          {"detected", "objects detected", false},
          {"missed", "objects not detected", true},
          {"no_photo", "photos that could not be taken: among very many none showed what was asked for", true},
          {"crowded", "photos that show more objects that count than can be told apart", true},
      };
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

[[figure]]
x = "object_class"
y = "detected"
group = "distance"
)";
  }

  std::vector<Label> labels() const override { return {{"detector", {}}}; }

  std::unique_ptr<Workspace> make_workspace(core::Isa isa) const override {
    return std::make_unique<DetectionScratch>(isa);
  }

  std::unique_ptr<const Simulation> prepare(const StudyKey& key, const Cell& cell,
                                            std::span<const Method>) const override {
    return std::make_unique<DetectionSimulation>(key, cell);
  }
};

}  // namespace

const Experiment& detection_experiment() {
  static const DetectionExperiment experiment;
  return experiment;
}

}  // namespace ridgeloc::studies
