#include "studies/study/conditions.hpp"

#include <algorithm>
#include <cassert>

namespace ridgeloc::studies {

bool is_read(const Study& study, const Setting& setting) {
  return is_read(study, Method{}, setting);
}

bool is_read(const Study& study, const Method& method, const Setting& setting) {
  if (setting.read_if.setting.empty()) return true;
  const auto& choices = setting.read_if.choices;
  const auto values = values_of(study, method, setting_named(*study.experiment, setting.read_if.setting));
  return std::ranges::any_of(values, [&](const Value& value) {
    return std::ranges::find(choices, std::get<std::string>(value)) != choices.end();
  });
}

bool depends_on_method(const Experiment& experiment, const Setting& setting) {
  return !setting.read_if.setting.empty() && setting_named(experiment, setting.read_if.setting).per_method;
}

const Setting& setting_named(const Experiment& experiment, std::string_view name) {
  const auto found = std::ranges::find(experiment.settings(), name, &Setting::name);
  assert(found != experiment.settings().end());
  return *found;
}

std::vector<Value> values_of(const Study& study, const Method& method, const Setting& setting) {
  const auto given = method.given.find(setting.name);
  if (given != method.given.end()) return {given->second};
  const auto fixed = study.fixed.find(setting.name);
  if (fixed != study.fixed.end()) return {fixed->second};
  const auto axis = std::ranges::find(study.sweep, setting.name, [](const SweepAxis& a) { return a.setting->name; });
  return axis == study.sweep.end() ? std::vector<Value>{} : axis->values;
}

}  // namespace ridgeloc::studies
