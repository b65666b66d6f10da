#include <algorithm>
#include <array>

#include "studies/building/building.hpp"
#include "studies/detection/detection.hpp"
#include "studies/ranging/ranging.hpp"
#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

std::span<const Experiment* const> experiment_registry() {
  static const std::array<const Experiment*, 3> registry = {&ranging_experiment(), &building_experiment(),
                                                            &detection_experiment()};
  return registry;
}

const Experiment* find_experiment(std::string_view name) {
  const auto registry = experiment_registry();
  const auto found = std::ranges::find(registry, name, [](const Experiment* e) { return e->name(); });
  return found == registry.end() ? nullptr : *found;
}

}  // namespace ridgeloc::studies
