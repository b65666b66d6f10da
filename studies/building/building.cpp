#include "studies/building/building.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "studies/building/building_schema.hpp"
#include "studies/building/building_simulation.hpp"
#include "studies/building/building_trials.hpp"
#include "studies/photos/building_settings.hpp"
#include "studies/solving/solver_settings.hpp"
#include "studies/study/capabilities.hpp"

namespace ridgeloc::studies {

namespace {

constexpr std::string_view photo_label = "photo";

class BuildingExperiment : public Experiment, public SolverChoice {
 public:
  std::string_view name() const override { return "building"; }
  std::string_view summary() const override {
    return "photos in a building: detection, coarse and fine positioning (RRR paper, Table 1, Fig. 6)";
  }
  int version() const override { return 3; }
  std::uint64_t block_trials() const override { return 512; }
  std::span<const Setting> settings() const override { return building_settings(); }
  const results::Schema& schema() const override { return building::schema(); }

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
    std::vector<std::string> names = settings_read_by(solver);
    std::erase_if(names, [](const std::string& name) {
      return std::ranges::find(building_settings(), name, &Setting::name) == building_settings().end();
    });
    return names;
  }

  std::vector<Label> labels() const override { return {{std::string(photo_label), {}}}; }

  std::unique_ptr<Workspace> make_workspace(core::Isa isa) const override {
    return std::make_unique<BuildingScratch>(isa);
  }

  std::unique_ptr<const Simulation> prepare(const StudyKey& key, const Cell& cell,
                                            std::span<const Method> methods) const override {
    return building_simulation(key, cell, methods);
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
};

}  // namespace

const Experiment& building_experiment() {
  static const BuildingExperiment experiment;
  return experiment;
}

}  // namespace ridgeloc::studies
