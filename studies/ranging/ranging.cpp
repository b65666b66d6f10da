#include "studies/ranging/ranging.hpp"

#include <array>

#include "core/error.hpp"
#include "core/problem.hpp"
#include "studies/ranging/given_objects.hpp"
#include "studies/ranging/ranging_schema.hpp"
#include "studies/ranging/ranging_settings.hpp"
#include "studies/ranging/ranging_simulation.hpp"
#include "studies/ranging/ranging_trials.hpp"
#include "studies/solving/solver_settings.hpp"
#include "studies/study/capabilities.hpp"

namespace ridgeloc::studies {

namespace {

constexpr std::string_view scene_label = "scene";

class Ranging : public Experiment,
                public SolverChoice,
                public ReferenceAudit,
                public Yardsticks,
                public TrialCost,
                public Remarks {
 public:
  std::string_view name() const override { return "ranging"; }
  std::string_view summary() const override {
    return "noisy ranges to objects in a field of view (RRR paper, section 4, Fig. 3), or at given places";
  }
  int version() const override { return 5; }
  std::uint64_t block_trials() const override { return 4096; }
  std::span<const Setting> settings() const override { return ranging_settings(); }
  const results::Schema& schema() const override { return ranging::schema(); }

  void check(const Values& cell) const override {
    const RangingCell settings(cell);
    if (settings.given) return check_given_objects(settings);
    const auto before_camera = [](const std::array<double, 2>& interval) {
      return interval[0] > -90.0 && interval[1] < 90.0;
    };
    if (settings.has_images &&
        !(before_camera(settings.view.azimuth_deg) && before_camera(settings.view.elevation_deg))) {
      throw core::InputError(
          "scene.model = \"pseudorange\" needs points before the camera: "
          "scene.azimuth_deg and scene.elevation_deg within -90 to 90, ends excluded");
    }
  }

  std::vector<std::string> remarks(const Values& cell) const override {
    const RangingCell settings(cell);
    const auto ambiguity = settings.given ? ambiguity_of_given_objects(settings) : std::nullopt;
    return ambiguity ? std::vector{*ambiguity} : std::vector<std::string>();
  }

  /// The bound is that of normal noise of one level. Over random scenes the mean of its square is finite from two
  /// observations more than unknowns on; with given objects it is where the camera is at few places, and elsewhere a
  /// box may hold places where they lie in line.
  results::BoundKind bound(const Values& cell) const override {
    const RangingCell settings(cell);
    if (!has_plain_noise(settings)) return results::BoundKind::None;
    const solvers::SolverOptions options = solver_options(cell, {});
    const bool seeks_distance = settings.has_images && options.v_mode != solvers::VMode::Fixed;
    const bool has_prior = settings.has_images && options.v_mode == solvers::VMode::Prior;
    if (settings.given) {
      return has_few_camera_places(settings) ? results::BoundKind::RootMeanSquare : results::BoundKind::Quantiles;
    }
    const std::size_t unknowns = core::position_parameters - (settings.knows_height ? 1 : 0) + (seeks_distance ? 1 : 0);
    const std::size_t observations = settings.points + (has_prior ? 1 : 0);
    return observations >= unknowns + 2 ? results::BoundKind::RootMeanSquare : results::BoundKind::Quantiles;
  }

  /// Iterations times observations.
  double cost(const Values& cell, const results::Statistics& statistics) const override {
    if (statistics.metrics.empty()) return 0.0;
    const results::Moments& iterations = statistics.metrics[ranging::Iterations].moments;
    return iterations.mean * static_cast<double>(iterations.n) * static_cast<double>(RangingCell(cell).points);
  }

  std::size_t audit_metrics() const override { return audit_metric_count; }

  std::string_view example() const override {
    return R"([sweep]
points = [3, 5, 7]
range_sigma_m = [0.1, 0.3, 0.5]

[[method]]
solver = "ols"

[[method]]
solver = "rr"

[[method]]
solver = "rrr"

[[figure]]
x = "points"
y = ["error_m", "converged"]
statistic = "median"
group = "range_sigma_m"
facet = "method"
methods = ["ols", "rr", "rrr"]
)";
  }

  std::vector<std::string> solvers() const override { return solver_names(); }

  std::vector<std::string> settings_of_solver(std::string_view solver) const override {
    return settings_read_by(solver);
  }

  std::vector<Label> labels() const override { return {{std::string(scene_label), {"v_mode"}}}; }

  std::unique_ptr<Workspace> make_workspace(core::Isa isa) const override {
    return std::make_unique<RangingScratch>(isa);
  }

  std::unique_ptr<const Simulation> prepare(const StudyKey& key, const Cell& cell,
                                            std::span<const Method> methods) const override {
    return ranging_simulation(key, cell, methods);
  }
};

}  // namespace

const Experiment& ranging_experiment() {
  static const Ranging experiment;
  return experiment;
}

}  // namespace ridgeloc::studies
