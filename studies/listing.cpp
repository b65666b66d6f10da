#include "studies/listing.hpp"

#include "sim/range_noise.hpp"
#include "solvers/estimators/formula_compiler.hpp"
#include "solvers/solver.hpp"
#include "studies/catalog/building_maps.hpp"
#include "studies/catalog/catalog.hpp"
#include "studies/files/map_reader.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

namespace {

template <class Registry>
std::vector<Listed> entries_of(const Registry& registry) {
  std::vector<Listed> entries;
  for (const auto& entry : registry) entries.push_back({std::string(entry.name), std::string(entry.summary)});
  return entries;
}

/// The estimators, and what formulas may be made of.
std::vector<Listed> estimators_of_k() {
  std::vector<Listed> entries = entries_of(solvers::k_estimator_registry());
  const auto add = [&entries](const auto& names) {
    for (const auto& entry : names)
      entries.push_back({"k_expr: " + std::string(entry.name), std::string(entry.summary)});
  };
  add(solvers::formula_quantities());
  add(solvers::formula_functions());
  return entries;
}

std::vector<Listed> metrics() {
  std::vector<Listed> entries;
  for (const Experiment* experiment : experiment_registry()) {
    const std::string of = std::string(experiment->name()) + ": ";
    for (const auto& m : experiment->schema().metrics) {
      entries.push_back({m.name, of + m.description + (m.unit == "1" ? "" : " (" + m.unit + ")")});
    }
    for (const auto& e : experiment->schema().events) entries.push_back({e.name, of + "rate of " + e.description});
  }
  return entries;
}

std::vector<Listed> maps() {
  std::vector<Listed> entries;
  for (const CatalogEntry& entry : building_maps()) {
    const sim::BuildingMap& map = find_building(entry.name)->map();
    entries.push_back({std::string(entry.name), map.name + ", " + std::to_string(map.objects.size()) + " objects"});
  }
  return entries;
}

std::vector<Listed> experiments() {
  std::vector<Listed> entries;
  for (const Experiment* e : experiment_registry())
    entries.push_back({std::string(e->name()), std::string(e->summary())});
  return entries;
}

std::vector<Listed> studies() {
  std::vector<Listed> entries;
  for (const CatalogEntry& entry : catalog()) {
    entries.push_back({std::string(entry.name), read_study(find_study(entry.name)).title});
  }
  return entries;
}

}  // namespace

const std::vector<std::string>& listing_topics() {
  static const std::vector<std::string> topics = {"solvers", "k",       "weights",     "noise",
                                                  "maps",    "metrics", "experiments", "studies"};
  return topics;
}

std::vector<Listed> list_topic(std::string_view topic) {
  if (topic == "solvers") return entries_of(solvers::solver_registry());
  if (topic == "k") return estimators_of_k();
  if (topic == "weights") return entries_of(solvers::weight_registry());
  if (topic == "noise") return entries_of(sim::noise_registry());
  if (topic == "maps") return maps();
  if (topic == "metrics") return metrics();
  if (topic == "experiments") return experiments();
  return studies();
}

}  // namespace ridgeloc::studies
