#include "studies/building/building.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "studies/building/building_outcome.hpp"
#include "studies/building/building_replay.hpp"
#include "studies/building/building_trials.hpp"
#include "studies/photos/building_settings.hpp"
#include "studies/solving/solver_settings.hpp"

namespace ridgeloc::studies {

namespace {

constexpr std::string_view photo_label = "photo";

// Columns of the schema, in its order.
enum Metric : std::size_t {
  ErrorM,
  Convergence,
  ConvergedStarts,
  Iterations,
  Starts,
  ObjectsVisible,
  ObjectsDetected,
  PseudorangeErrorM,
  CoarseErrorM,
  CoarseMeanErrorM,
  CoarseRight
};

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
  schema.events = {
      {"success", "photos located", false},
      {"outside_map", "photos of which starts converge, none of them inside the map", true},
      {"diverged", "photos of which no start converges", true},
      {"no_start", "photos without a coarse position", true},
  };
  schema.statuses = schema.events.size();
  return schema;
}

class BuildingExperiment : public Experiment {
 public:
  std::string_view name() const override { return "building"; }
  std::string_view summary() const override {
    return "photos in a building: detection, coarse and fine positioning (RRR paper, Table 1, Fig. 6)";
  }
  int version() const override { return 1; }
  std::uint64_t block_trials() const override { return 512; }
  std::span<const Setting> settings() const override { return building_settings(); }
  const results::Schema& schema() const override {
    static const results::Schema schema = make_schema();
    return schema;
  }

  void check(const Values& cell) const override {
    const BuildingCell settings(cell);
    if (settings.detections == 1 || settings.detections == 2) {
      throw core::InputError(fmt::format(
          "photo.detections = {}: a position and an image distance need 3 detections at least (0: as in Table 1)",
          settings.detections));
    }
    check_grids(settings);
  }

  std::string_view example() const override {
    return R"([sweep]
detections = [3, 4, 5, 6, 7]

[[method]]
solver = "ols"

[[method]]
solver = "lm"

[[method]]
solver = "rr"

[[method]]
solver = "rrr"

[[figure]]
x = "detections"
y = "success"
group = "method"
)";
  }

  std::vector<std::string> solvers() const override { return solver_names(); }

  std::vector<std::string> settings_of_solver(std::string_view solver) const override {
    if (solver == photo_label) return {};
    std::vector<std::string> names = settings_read_by(solver);
    std::erase_if(names, [](const std::string& name) {
      return std::ranges::find(building_settings(), name, &Setting::name) == building_settings().end();
    });
    return names;
  }

  std::vector<std::string> extra_labels() const override { return {std::string(photo_label)}; }

  std::unique_ptr<Workspace> make_workspace(core::Isa isa) const override {
    return std::make_unique<BuildingScratch>(isa);
  }

  void run_block(const StudyKey& key, const Cell& cell, std::span<const Method> methods, TrialRange range,
                 Workspace& workspace, results::BlockSink& sink) const override {
    auto& scratch = static_cast<BuildingScratch&>(workspace);
    const BuildingCell settings(cell.values);
    simulate_and_locate(key.seed, cell, settings, methods, range, scratch);
    for (std::size_t m = 0; m < methods.size(); ++m) report_method(m, scratch, sink);
    report_photos(methods.size(), settings.starts == StartPlaces::Coarse, scratch, sink);
  }

  std::vector<FailureCounts> count_failures(std::uint64_t seed, const Cell& cell, std::span<const Method> methods,
                                            TrialRange range, Workspace& workspace) const override {
    auto& scratch = static_cast<BuildingScratch&>(workspace);
    simulate_and_locate(seed, cell, BuildingCell(cell.values), methods, range, scratch);
    std::vector<FailureCounts> counts;
    for (const std::vector<PhotoOutcome>& outcomes : scratch.block_outcomes) {
      FailureCounts& count = counts.emplace_back();
      count.trials = range.count;
      const auto failed = [](const PhotoOutcome& outcome) { return outcome.status != PhotoStatus::Success; };
      count.failed = static_cast<std::uint64_t>(std::ranges::count_if(outcomes, failed));
    }
    return counts;
  }

  Replay replay(std::uint64_t seed, const Cell& cell, std::span<const Method> methods, std::uint64_t trial,
                Workspace& workspace) const override {
    return replay_building(seed, cell, methods, trial, static_cast<BuildingScratch&>(workspace));
  }

 private:
  /// Refuses grids that would take hours and gigabytes.
  static void check_grids(const BuildingCell& settings) {
    constexpr std::size_t most_starts = 200'000;
    constexpr std::size_t most_views = 1'000'000;
    const sim::BuildingMap& map = *settings.photo.map;
    if (settings.starts == StartPlaces::Grid) {
      const std::size_t starts = grid_size(map, settings.start_spacing_m);
      if (starts <= most_starts) return;
      throw core::InputError(fmt::format(
          "coarse.start_spacing_m = {}: that makes {} starts on the map \"{}\", more than {}; make it larger",
          settings.start_spacing_m, starts, map.name, most_starts));
    }
    const std::size_t places = grid_size(map, settings.grid_spacing_m);
    if (places <= most_views / settings.grid_headings) return;
    throw core::InputError(
        fmt::format("coarse.grid_spacing_m = {}, coarse.grid_headings = {}: that makes views from {} places of the map "
                    "\"{}\", more than {} in all; make the spacing larger or take fewer headings",
                    settings.grid_spacing_m, settings.grid_headings, places, map.name, most_views));
  }

  /// Writes what is known of all photos of a range, and how each method ends on them, into what the scratch memory has
  /// of a block.
  static void simulate_and_locate(std::uint64_t seed, const Cell& cell, const BuildingCell& settings,
                                  std::span<const Method> methods, TrialRange range, BuildingScratch& scratch) {
    scratch.block_photos.clear();
    scratch.block_outcomes.resize(methods.size());
    for (std::vector<PhotoOutcome>& outcomes : scratch.block_outcomes) outcomes.clear();
    const auto append = [](const auto& some, auto& all) { all.insert(all.end(), some.begin(), some.end()); };
    const std::size_t most = photos_at_once(settings);
    for (std::size_t done = 0; done < range.count; done = scratch.block_photos.size()) {
      const std::size_t count = std::min(most, range.count - done);
      simulate_building(seed, cell, settings, {range.first + done, count}, scratch);
      append(scratch.photos, scratch.block_photos);
      for (std::size_t m = 0; m < methods.size(); ++m) {
        locate(*settings.photo.map, methods[m], solver_options(cell.values, methods[m].given), scratch);
        append(scratch.outcomes, scratch.block_outcomes[m]);
      }
    }
  }

  /// Writes f(photo) for every photo into one column of the sink.
  template <class Record, class F>
  static void report(std::size_t method, Metric metric, const std::vector<Record>& records, BuildingScratch& scratch,
                     results::BlockSink& sink, F&& value) {
    scratch.values.resize(records.size());
    std::ranges::transform(records, scratch.values.begin(), value);
    sink.metric(method, metric, scratch.values);
  }

  static void report_method(std::size_t m, BuildingScratch& scratch, results::BlockSink& sink) {
    constexpr double not_in_population = std::numeric_limits<double>::quiet_NaN();
    const std::vector<PhotoOutcome>& outcomes = scratch.block_outcomes[m];
    scratch.codes.resize(outcomes.size());
    std::ranges::transform(outcomes, scratch.codes.begin(),
                           [](const PhotoOutcome& o) { return static_cast<std::uint8_t>(o.status); });
    sink.status(m, scratch.codes);
    const auto of_located = [&](Metric metric, double PhotoOutcome::*member) {
      report(m, metric, outcomes, scratch, sink, [member](const PhotoOutcome& o) {
        return o.status == PhotoStatus::Success ? o.*member : not_in_population;
      });
    };
    of_located(ErrorM, &PhotoOutcome::error_m);
    report(m, Convergence, outcomes, scratch, sink, [](const PhotoOutcome& o) {
      return o.starts == 0 ? not_in_population : static_cast<double>(o.inside) / static_cast<double>(o.starts);
    });
    report(m, ConvergedStarts, outcomes, scratch, sink,
           [](const PhotoOutcome& o) { return static_cast<double>(o.inside); });
    of_located(Iterations, &PhotoOutcome::iterations);
  }

  static void report_photos(std::size_t label, bool coarse, BuildingScratch& scratch, results::BlockSink& sink) {
    const auto number = [&](Metric metric, std::size_t PhotoRecord::*member) {
      report(label, metric, scratch.block_photos, scratch, sink,
             [member](const PhotoRecord& r) { return static_cast<double>(r.*member); });
    };
    const auto value = [&](Metric metric, double PhotoRecord::*member) {
      report(label, metric, scratch.block_photos, scratch, sink, [member](const PhotoRecord& r) { return r.*member; });
    };
    number(Metric::Starts, &PhotoRecord::starts);
    number(ObjectsVisible, &PhotoRecord::visible);
    number(ObjectsDetected, &PhotoRecord::detections);
    value(PseudorangeErrorM, &PhotoRecord::pseudorange_error_m);
    if (!coarse) return;
    value(CoarseErrorM, &PhotoRecord::coarse_error_m);
    value(CoarseMeanErrorM, &PhotoRecord::coarse_mean_error_m);
    value(CoarseRight, &PhotoRecord::coarse_right);
  }
};

}  // namespace

const Experiment& building_experiment() {
  static const BuildingExperiment experiment;
  return experiment;
}

}  // namespace ridgeloc::studies
