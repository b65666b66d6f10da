#include "studies/detection/detection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "studies/detection/detection_replay.hpp"
#include "studies/detection/detection_trials.hpp"

namespace ridgeloc::studies {

namespace {

constexpr std::string_view detector_name = "detector";

enum Metric : std::size_t { PseudorangeErrorM, RangeM };
enum Status : std::uint8_t { Detected, Missed };

struct DetectionScratch : Workspace {
  using Workspace::Workspace;

  sim::Photo photo;
  std::vector<std::uint8_t> codes;
  std::vector<double> errors;
  std::vector<double> ranges;
};

class DetectionExperiment : public Experiment {
 public:
  std::string_view name() const override { return "detection"; }
  std::string_view summary() const override { return "objects in photos of a building: found or missed (Fig. 5)"; }
  int version() const override { return 1; }
  std::uint64_t block_trials() const override { return 1024; }
  std::span<const Setting> settings() const override { return detection_experiment_settings(); }

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
    const DetectionTrials trials(key.seed, settings);
    scratch.codes.resize(range.count);
    scratch.errors.resize(range.count);
    scratch.ranges.resize(range.count);
    for (std::size_t t = 0; t < range.count; ++t) {
      const Sighting sighting = trials.take(range.first + t, scratch.photo);
      scratch.ranges[t] = sighting.view.range_m;
      scratch.codes[t] = sighting.detection ? Detected : Missed;
      scratch.errors[t] = std::fabs(sighting.pseudorange_m - sighting.view.range_m);
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
    const DetectionTrials trials(seed, settings);
    FailureCounts count;
    count.trials = range.count;
    for (std::size_t t = 0; t < range.count; ++t) {
      count.failed += trials.take(range.first + t, scratch.photo).detection ? 0 : 1;
    }
    return std::vector<FailureCounts>(methods.size(), count);
  }

  Replay replay(std::uint64_t seed, const Cell& cell, std::span<const Method> methods, std::uint64_t trial,
                Workspace& workspace) const override {
    return replay_detection(seed, DetectionCell(cell.values), methods, trial,
                            static_cast<DetectionScratch&>(workspace).photo);
  }
};

}  // namespace

const Experiment& detection_experiment() {
  static const DetectionExperiment experiment;
  return experiment;
}

}  // namespace ridgeloc::studies
