#include "studies/registry.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "studies/building/building.hpp"
#include "studies/detection/detection.hpp"
#include "studies/ranging/ranging.hpp"

namespace ridgeloc::studies {

namespace {

std::vector<const Experiment*>& registry() {
  static std::vector<const Experiment*> all = {&ranging_experiment(), &building_experiment(), &detection_experiment()};
  return all;
}

}  // namespace

std::span<const Experiment* const> experiment_registry() {
  return registry();
}

void add_experiment(const Experiment& experiment) {
  if (find_experiment(experiment.name()) != nullptr)
    throw std::invalid_argument("an experiment of that name is there: " + std::string(experiment.name()));
  registry().push_back(&experiment);
}

const Experiment* find_experiment(std::string_view name) {
  const auto all = experiment_registry();
  const auto found = std::ranges::find(all, name, [](const Experiment* e) { return e->name(); });
  return found == all.end() ? nullptr : *found;
}

Study read_study(const StudySource& source, std::span<const std::string> overrides) {
  return read_study(source, overrides, experiment_registry());
}

}  // namespace ridgeloc::studies
