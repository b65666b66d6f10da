#include "studies/building/building_simulation.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "studies/building/building_outcome.hpp"
#include "studies/building/building_replay.hpp"
#include "studies/building/building_schema.hpp"
#include "studies/building/building_trials.hpp"
#include "studies/photos/building_settings.hpp"
#include "studies/solving/solver_settings.hpp"
#include "studies/study/capabilities.hpp"

namespace ridgeloc::studies {

namespace {

using namespace building;

constexpr double not_in_population = std::numeric_limits<double>::quiet_NaN();

class BuildingSimulation : public Simulation, public FailureRecount, public TrialReplay {
 public:
  BuildingSimulation(const StudyKey& key, const Cell& cell, std::span<const Method> methods)
      : scene_(key.seed, cell), methods_(methods.begin(), methods.end()) {
    for (const Method& method : methods_) options_.push_back(solver_options(cell.values, method.given));
  }

  bool run_block(TrialRange range, Workspace& workspace, Monitor& monitor, results::BlockSink& sink) const override {
    auto& scratch = own<BuildingScratch>(workspace);
    if (!simulate_and_locate(range, scratch, monitor)) return false;
    for (std::size_t m = 0; m < methods_.size(); ++m) report_method(m, scratch, sink);
    report_photos(methods_.size(), scene_.settings.starts == StartPlaces::Coarse, scratch, sink);
    return true;
  }

  std::vector<FailureCounts> count_failures(TrialRange range, Workspace& workspace) const override {
    auto& scratch = own<BuildingScratch>(workspace);
    NoMonitor monitor;
    static_cast<void>(simulate_and_locate(range, scratch, monitor));
    std::vector<FailureCounts> counts;
    for (const std::vector<PhotoOutcome>& outcomes : scratch.block_outcomes) {
      FailureCounts& count = counts.emplace_back();
      count.trials = range.count;
      const auto failed = [](const PhotoOutcome& outcome) { return outcome.status != PhotoStatus::Success; };
      count.failed = static_cast<std::uint64_t>(std::ranges::count_if(outcomes, failed));
    }
    return counts;
  }

  Replay replay(std::uint64_t trial, Workspace& workspace) const override {
    return replay_building(scene_, methods_, options_, trial, own<BuildingScratch>(workspace));
  }

 private:
  /// Writes what is known of all photos of a range, and how each method ends on them, into what the scratch memory has
  /// of a block. Returns whether it came to an end.
  bool simulate_and_locate(TrialRange range, BuildingScratch& scratch, Monitor& monitor) const {
    scratch.block_photos.clear();
    scratch.block_outcomes.resize(methods_.size());
    for (std::vector<PhotoOutcome>& outcomes : scratch.block_outcomes) outcomes.clear();
    const auto append = [](const auto& some, auto& all) { all.insert(all.end(), some.begin(), some.end()); };
    const std::size_t most = photos_at_once(scene_.settings);
    for (std::size_t done = 0; done < range.count; done = scratch.block_photos.size()) {
      const std::size_t count = std::min(most, range.count - done);
      if (!simulate_building(scene_, {range.first + done, count}, monitor, scratch)) return false;
      append(scratch.photos, scratch.block_photos);
      for (std::size_t m = 0; m < methods_.size(); ++m) {
        if (!locate(*scene_.settings.photo.map, methods_[m], options_[m], monitor, scratch)) return false;
        append(scratch.outcomes, scratch.block_outcomes[m]);
      }
      monitor.advance(count);
    }
    return true;
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
    report(m, ConvergedStarts, outcomes, scratch, sink, [](const PhotoOutcome& o) {
      return o.status == PhotoStatus::NoPhoto ? not_in_population : static_cast<double>(o.inside);
    });
    of_located(Iterations, &PhotoOutcome::iterations);
  }

  static void report_photos(std::size_t label, bool coarse, BuildingScratch& scratch, results::BlockSink& sink) {
    const auto number = [&](Metric metric, std::size_t PhotoRecord::*member) {
      report(label, metric, scratch.block_photos, scratch, sink, [member](const PhotoRecord& r) {
        return r.is_taken ? static_cast<double>(r.*member) : not_in_population;
      });
    };
    const auto value = [&](Metric metric, double PhotoRecord::*member) {
      report(label, metric, scratch.block_photos, scratch, sink,
             [member](const PhotoRecord& r) { return r.is_taken ? r.*member : not_in_population; });
    };
    number(Starts, &PhotoRecord::starts);
    number(ObjectsVisible, &PhotoRecord::visible);
    number(ObjectsDetected, &PhotoRecord::detections);
    value(PseudorangeErrorM, &PhotoRecord::pseudorange_error_m);
    if (!coarse) return;
    value(CoarseErrorM, &PhotoRecord::coarse_error_m);
    value(CoarseMeanErrorM, &PhotoRecord::coarse_mean_error_m);
    value(CoarseRight, &PhotoRecord::coarse_right);
  }

  BuildingScene scene_;
  std::vector<Method> methods_;
  std::vector<solvers::SolverOptions> options_;
};

}  // namespace

std::unique_ptr<const Simulation> building_simulation(const StudyKey& key, const Cell& cell,
                                                      std::span<const Method> methods) {
  return std::make_unique<BuildingSimulation>(key, cell, methods);
}

}  // namespace ridgeloc::studies
