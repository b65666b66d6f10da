#include "studies/run/workbench.hpp"

#include <utility>

namespace ridgeloc::studies {

Workbench::Workbench(const Study& study, const Plan& plan, std::size_t workers)
    : study_(study), plan_(plan), places_(workers) {}

Workspace& Workbench::workspace(std::size_t worker) {
  std::unique_ptr<Workspace>& workspace = places_[worker].workspace;
  if (workspace == nullptr) workspace = study_.experiment->make_workspace(plan_.isa);
  return *workspace;
}

const Simulation& Workbench::simulation(std::size_t worker, std::size_t cell, std::span<const Method> methods) {
  Key key{cell, {}};
  for (const Method& method : methods) key.second.push_back(method.label);
  Place& place = places_[worker];
  if (place.simulation == nullptr || place.key != key) {
    place.simulation = shared(key, methods);
    place.key = std::move(key);
  }
  return *place.simulation;
}

std::shared_ptr<const Simulation> Workbench::shared(const Key& key, std::span<const Method> methods) {
  // Held while one is prepared: what takes long to prepare is what others would rather wait for than make again.
  const std::scoped_lock lock(mutex_);
  if (auto known = simulations_[key].lock()) return known;
  std::shared_ptr<const Simulation> made =
      study_.experiment->prepare({study_.seed, study_.audit}, plan_.cells[key.first], methods);
  std::erase_if(simulations_, [](const auto& entry) { return entry.second.expired(); });
  simulations_[key] = made;
  return made;
}

}  // namespace ridgeloc::studies
