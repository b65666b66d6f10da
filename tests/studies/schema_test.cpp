// What the names of all experiments must keep to.

#include <algorithm>
#include <set>
#include <string>

#include "results/schema/schema.hpp"
#include "studies/registry.hpp"
#include "studies/study/capabilities.hpp"
#include "studies/study/experiment.hpp"
#include "tests/support/catch.hpp"

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

TEST_CASE("settings that are read at times depend on a choice that the experiment has") {
  for (const Experiment* experiment : experiment_registry()) {
    const auto settings = experiment->settings();
    for (const Setting& setting : settings) {
      if (setting.read_if.setting.empty()) continue;
      INFO(experiment->name() << ": " << setting.name);
      const auto other = std::ranges::find(settings, setting.read_if.setting, &Setting::name);
      REQUIRE(other != settings.end());
      CHECK(other->kind == Kind::Choice);
      CHECK_FALSE(setting.read_if.choices.empty());
      for (const std::string& choice : setting.read_if.choices) CHECK(std::ranges::count(other->choices, choice) == 1);
    }
  }
}

TEST_CASE("every solver reads settings that the experiment has") {
  for (const Experiment* experiment : experiment_registry()) {
    std::set<std::string> settings;
    for (const Setting& setting : experiment->settings()) settings.insert(setting.name);
    for (const std::string& solver : solvers_of(*experiment)) {
      for (const std::string& name : settings_read_for(*experiment, solver)) {
        INFO(experiment->name() << ", " << solver << ": " << name);
        CHECK(settings.contains(name));
      }
    }
  }
}
