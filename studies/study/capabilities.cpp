#include "studies/study/capabilities.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace ridgeloc::studies {

void refuse_missing(const Experiment& experiment, std::string_view what) {
  throw core::InputError(fmt::format("the experiment \"{}\" offers no {}", experiment.name(), what));
}

std::vector<std::string> solvers_of(const Experiment& experiment) {
  const auto* choice = offered<SolverChoice>(experiment);
  return choice == nullptr ? std::vector<std::string>() : choice->solvers();
}

std::vector<std::string> settings_read_for(const Experiment& experiment, std::string_view name) {
  const std::vector<Label> labels = experiment.labels();
  const auto label = std::ranges::find(labels, name, &Label::name);
  if (label != labels.end()) return label->settings;
  const auto* choice = offered<SolverChoice>(experiment);
  return choice == nullptr ? std::vector<std::string>() : choice->settings_of_solver(name);
}

std::vector<std::string> label_names(const Experiment& experiment) {
  std::vector<std::string> names;
  for (Label& label : experiment.labels()) names.push_back(std::move(label.name));
  return names;
}

std::size_t audit_metrics_of(const Experiment& experiment) {
  const auto* audit = offered<ReferenceAudit>(experiment);
  return audit == nullptr ? 0 : audit->audit_metrics();
}

results::BoundKind bound_of(const Experiment& experiment, const Values& cell) {
  const auto* yardsticks = offered<Yardsticks>(experiment);
  return yardsticks == nullptr ? results::BoundKind::None : yardsticks->bound(cell);
}

std::vector<std::string> remarks_on(const Experiment& experiment, const Values& cell) {
  const auto* remarks = offered<Remarks>(experiment);
  return remarks == nullptr ? std::vector<std::string>() : remarks->remarks(cell);
}

double cost_of(const Experiment& experiment, const Values& cell, const results::Statistics& statistics) {
  const auto* cost = offered<TrialCost>(experiment);
  return cost == nullptr ? static_cast<double>(statistics.trials) : cost->cost(cell, statistics);
}

}  // namespace ridgeloc::studies
