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
    place.simulation = prepared(key, methods);
    place.key = std::move(key);
  }
  return *place.simulation;
}

std::shared_ptr<Workbench::Shared> Workbench::shared_of(const Key& key) {
  const std::scoped_lock lock(mutex_);
  // Nobody is at work on, or about to make, what only the map knows.
  std::erase_if(shared_,
                [](const auto& entry) { return entry.second.use_count() == 1 && entry.second->simulation.expired(); });
  std::shared_ptr<Shared>& shared = shared_[key];
  if (shared == nullptr) shared = std::make_shared<Shared>();
  return shared;
}

std::shared_ptr<const Simulation> Workbench::prepared(const Key& key, std::span<const Method> methods) {
  const std::shared_ptr<Shared> shared = shared_of(key);
  const std::scoped_lock lock(shared->mutex);
  if (auto known = shared->simulation.lock()) return known;
  std::shared_ptr<const Simulation> made =
      study_.experiment->prepare({study_.seed, study_.audit}, plan_.cells[key.first], methods);
  shared->simulation = made;
  return made;
}

}  // namespace ridgeloc::studies
