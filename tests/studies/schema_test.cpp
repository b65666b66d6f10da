// What the names of all experiments must keep to.

#include <set>
#include <string>

#include "catch.hpp"
#include "results/schema.hpp"
#include "studies/experiment.hpp"

using namespace ridgeloc::studies;

TEST_CASE("no metric or event has the name of another, of a setting or of a dimension") {
  // They stand beside each other in the summary group of a result.
  for (const Experiment* experiment : experiment_registry()) {
    INFO(experiment->name());
    std::set<std::string> names = {"method", "statistic"};
    const auto add = [&names](const std::string& name) {
      INFO(name);
      CHECK(names.insert(name).second);
    };
    for (const Setting& setting : experiment->settings()) add(setting.name);
    for (const auto& metric : experiment->schema().metrics) add(metric.name);
    for (const auto& event : experiment->schema().events) add(event.name);
  }
}

TEST_CASE("every solver reads settings that the experiment has") {
  for (const Experiment* experiment : experiment_registry()) {
    std::set<std::string> settings;
    for (const Setting& setting : experiment->settings()) settings.insert(setting.name);
    for (const std::string& solver : experiment->solvers()) {
      for (const std::string& name : experiment->settings_of_solver(solver)) {
        INFO(experiment->name() << ", " << solver << ": " << name);
        CHECK(settings.contains(name));
      }
    }
  }
}
